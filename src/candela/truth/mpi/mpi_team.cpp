// The team of an MPI job, as a module of its own: a process that was not started by mpirun never loads MPI.
#include <mpi.h>

#include <algorithm>
#include <climits>
#include <cstddef>
#include <span>

#include "candela/truth/team.hpp"

namespace candela::truth {
namespace {

class MpiTeam final : public Team {
  public:
    MpiTeam() {
        int already = 0;
        MPI_Initialized(&already);
        // Sums are computed on many threads; only the main one talks.
        int provided = 0;
        if (already == 0) MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &size_);
    }
    ~MpiTeam() override {
        int done = 0;
        MPI_Finalized(&done);
        if (done == 0) MPI_Finalize();
    }
    MpiTeam(const MpiTeam&) = delete;
    MpiTeam& operator=(const MpiTeam&) = delete;

    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int size() const override { return size_; }
    void send(std::span<const float> sums) override {
        pieces(sums.size(), [&](std::size_t at, int count) {
            MPI_Send(sums.data() + at, count, MPI_FLOAT, 0, 0, MPI_COMM_WORLD);
        });
    }
    void receive(int rank, std::span<float> sums) override {
        pieces(sums.size(), [&](std::size_t at, int count) {
            MPI_Recv(sums.data() + at, count, MPI_FLOAT, rank, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        });
    }
    void broadcast(std::span<std::byte> bytes) override {
        pieces(bytes.size(), [&](std::size_t at, int count) {
            MPI_Bcast(bytes.data() + at, count, MPI_BYTE, 0, MPI_COMM_WORLD);
        });
    }

    void abort(int exit_code) override { MPI_Abort(MPI_COMM_WORLD, exit_code); }

  private:
    /// MPI counts with int.
    template <class Transfer>
    static void pieces(std::size_t total, const Transfer& transfer) {
        constexpr std::size_t most = INT_MAX / 2;
        for (std::size_t at = 0; at < total; at += most)
            transfer(at, static_cast<int>(std::min(most, total - at)));
    }
    int rank_ = 0;
    int size_ = 1;
};

}  // namespace
}  // namespace candela::truth

/// Found by name in team.cpp. The caller owns the result.
extern "C" candela::truth::Team* candela_join_mpi_team() {
    return std::make_unique<candela::truth::MpiTeam>().release();
}
