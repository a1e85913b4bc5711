#include <filesystem>
#include <fstream>

#include "photometric/photometric_files.hpp"

using namespace candela::test;

namespace {

void write(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace

/// Writes one small file a feature into the folder: where the fuzzer starts.
int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    for (const char* line : {"label", "IESNA91", "IESNA:LM-63-1995", "IESNA:LM-63-2002", "IES:LM-63-2019"}) {
        IesFile file;
        file.first_line = line;
        file.horizontal = {0, 90, 180};
        std::string name(line);
        for (char& c : name) c = c == ':' ? '_' : c;
        write(folder / (name + ".ies"), file.bytes());
    }
    for (int type : {2, 3}) {
        IesFile file;
        file.type = type;
        file.vertical = file.horizontal = {-90, -45, 0, 45, 90};
        write(folder / ("type" + std::to_string(type) + ".ies"), file.bytes());
    }
    IesFile tilted;
    tilted.tilt = "TILT=INCLUDE\n1\n3\n0 45 90\n1 .9 .8";
    write(folder / "tilt.ies", tilted.bytes());
    for (int symmetry = 0; symmetry <= 4; ++symmetry) {
        LdtFile file;
        file.symmetry = symmetry;
        file.planes = {0, 90, 180, 270};
        if (symmetry == 1) file.sets.push_back({-2, 500.0, "840", 9.0});
        write(folder / ("symmetry" + std::to_string(symmetry) + ".ldt"), file.bytes("\n"));
    }
    return 0;
}
