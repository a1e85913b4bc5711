#include "candela/scene/memory_budget.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "candela/scene/error.hpp"

using namespace candela;

TEST(MemoryBudget, IsReadInPowersOf1024) {
    const auto bytes = [](const char* text) { return scene::memory_from_text(text, "--memory").bytes; };
    EXPECT_EQ(bytes("4096"), 4096u);
    EXPECT_EQ(bytes("512M"), std::uint64_t{512} << 20);
    EXPECT_EQ(bytes("1.5G"), std::uint64_t{3} << 29);
    EXPECT_EQ(bytes("6GiB"), std::uint64_t{6} << 30);
    EXPECT_EQ(bytes("2 gb"), std::uint64_t{2} << 30);
    EXPECT_EQ(bytes("1T"), std::uint64_t{1} << 40);
    for (const char* bad : {"", "G", "-1G", "0", "nan", "1Q", "1GiBi", "1e30", "4 4"}) {
        try {
            (void)scene::memory_from_text(bad, "--memory");
            ADD_FAILURE() << bad;
        } catch (const Error& error) {
            EXPECT_EQ(error.fault(), Fault::usage) << bad;
        }
    }
}

TEST(MemoryBudget, SaysWhatIsNeededAndWhatThereIs) {
    const scene::MemoryBudget budget{std::uint64_t{3} << 30, true};
    EXPECT_NO_THROW(budget.require(std::uint64_t{3} << 30, "the scene takes", "a.glb"));
    try {
        budget.require(std::uint64_t{13} << 29, "the scene takes", "a.glb");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::machine);
        EXPECT_EQ(error.line(),
                  "a.glb: the scene takes 6.5 GiB of memory, --memory allows 3.0 GiB (a larger --memory)");
    }
}

TEST(MemoryBudget, FollowsTheProcessesAddressSpace) {
    EXPECT_GT(scene::available_memory().bytes, std::uint64_t{1} << 20);
    const pid_t child = fork();
    if (child == 0) {
        const rlimit space{std::size_t{1} << 30, std::size_t{1} << 30};
        setrlimit(RLIMIT_AS, &space);
        _exit(scene::available_memory().bytes < (std::uint64_t{1} << 30) ? 0 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
}
