#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace candela::truth {

/// The processes that share one picture. Rank 0 keeps the film; the others send it what they sum up.
class Team {
  public:
    virtual ~Team() = default;
    [[nodiscard]] virtual int rank() const = 0;
    [[nodiscard]] virtual int size() const = 0;
    /// To rank 0, from another.
    virtual void send(std::span<const float> sums) = 0;
    /// From `rank`, at rank 0. The sizes have to agree.
    virtual void receive(int rank, std::span<float> sums) = 0;
    /// What rank 0 holds becomes what all hold.
    virtual void broadcast(std::span<std::byte> bytes) = 0;
    /// Ends every process of the team with this exit code: after an error the others would wait for ever.
    /// Does nothing in a team of one.
    virtual void abort(int exit_code) = 0;
};

/// The handle of the MPI module of `folder`, or of truth/mpi below it as a build has it. Throws Error
/// (Fault::machine), in different words when there is no module and when it cannot be loaded, as without Open
/// MPI.
[[nodiscard]] void* open_mpi_module(const std::filesystem::path& folder);

/// The team that this process was started in: of `mpirun`, when it was and the MPI module is installed beside
/// the library; else a team of one. Throws Error (Fault::machine) when it was started by mpirun and the
/// module is missing.
[[nodiscard]] std::unique_ptr<Team> join_team();

}  // namespace candela::truth
