#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "candela/scene/error.hpp"
#include "demo_scenes.hpp"

namespace candela::scenes {

namespace {

void write(const std::filesystem::path& folder, const std::vector<std::string>& names) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) throw machine_error("the folder cannot be made: " + failure.message(), folder.string());
    for (const Demo& demo : demos())
        if (names.empty() || std::find(names.begin(), names.end(), demo.name) != names.end())
            demo.write(folder);
}

int run(int argc, char** argv) {
    CLI::App app("Writes the demo scenes of Candela as glTF with stage files and environments.");
    std::filesystem::path folder;
    std::vector<std::string> names, known;
    bool list = false;
    for (const Demo& demo : demos()) known.push_back(demo.name);
    app.add_option("FOLDER", folder, "Where to write; made if missing");
    app.add_option("--only", names, "These scenes only")->check(CLI::IsMember(known))->delimiter(',');
    app.add_flag("--list", list, "Say what there is, and write nothing");
    try {
        app.parse(argc, argv);
        if (!list && folder.empty()) throw CLI::RequiredError("FOLDER");
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(Fault::usage);
    }
    if (list) {
        for (const Demo& demo : demos()) std::cout << demo.name << ": " << demo.about << '\n';
        return 0;
    }
    write(folder, names);
    return 0;
}

}  // namespace
}  // namespace candela::scenes

int main(int argc, char** argv) {
    try {
        return candela::scenes::run(argc, argv);
    } catch (const candela::Error& error) {
        std::cerr << error.line() << '\n';
        return static_cast<int>(error.fault());
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return static_cast<int>(candela::Fault::machine);
    }
}
