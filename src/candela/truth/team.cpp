#include "candela/truth/team.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "candela/scene/error.hpp"

namespace candela::truth {
namespace {

constexpr const char* kModule = "libcandela-mpi.so";

class Alone final : public Team {
  public:
    [[nodiscard]] int rank() const override { return 0; }
    [[nodiscard]] int size() const override { return 1; }
    void send(std::span<const float>) override {}
    void receive(int, std::span<float>) override {}
    void broadcast(std::span<std::byte>) override {}
    void abort(int) override {}
};

/// Open MPI, MPICH and Slurm's launchers each leave one of these.
bool started_by_mpi() {
    return std::getenv("OMPI_COMM_WORLD_SIZE") || std::getenv("PMI_SIZE") || std::getenv("PMIX_RANK");
}

/// The folder of the library or program that this function is in, and below the build's folders.
std::filesystem::path own_folder() {
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(&join_team), &info) == 0 || !info.dli_fname) return {};
    return std::filesystem::path(info.dli_fname).parent_path();
}

}  // namespace

void* open_mpi_module(const std::filesystem::path& folder) {
    for (const std::filesystem::path& file : {folder / kModule, folder / "truth" / "mpi" / kModule}) {
        std::error_code none;
        if (!std::filesystem::exists(file, none)) continue;
        if (void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) return module;
        const char* why = dlerror();
        throw machine_error("started by mpirun, but Open MPI's libraries cannot be loaded: " +
                                std::string(why != nullptr ? why : "no reason given"),
                            file.string(), "install Open MPI (Debian: libopenmpi3), or start without mpirun");
    }
    throw machine_error("started by mpirun, but this build of Candela has no MPI module",
                        (folder / kModule).string(),
                        "install libopenmpi-dev, configure and build again, or start without mpirun");
}

std::unique_ptr<Team> join_team() {
    if (!started_by_mpi()) return std::make_unique<Alone>();
    // Never closed: MPI's own libraries do not survive it.
    void* symbol = dlsym(open_mpi_module(own_folder()), "candela_join_mpi_team");
    if (!symbol) throw machine_error("the MPI module is of another version", kModule, "build both again");
    return std::unique_ptr<Team>(reinterpret_cast<Team* (*)()>(symbol)());
}

}  // namespace candela::truth
