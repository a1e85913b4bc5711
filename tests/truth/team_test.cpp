// Which of two things is missing: the module of this build, or Open MPI on this machine.
#include "candela/truth/team.hpp"

#include <gtest/gtest.h>

#include "candela/scene/error.hpp"
#include "common/files.hpp"

namespace candela::truth {
namespace {

Error error_of(const std::filesystem::path& folder) {
    try {
        (void)open_mpi_module(folder);
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "loaded from " << folder;
    return machine_error("");
}

TEST(Team, AMissingModuleIsSaidToBeMissing) {
    const test::TemporaryFolder folder;
    const Error error = error_of(folder.path());
    EXPECT_EQ(error.fault(), Fault::machine);
    EXPECT_NE(error.line().find("this build of Candela has no MPI module"), std::string::npos)
        << error.line();
    EXPECT_NE(error.line().find("libopenmpi-dev"), std::string::npos) << error.line();
}

TEST(Team, AMissingOpenMpiIsSaidWithTheLibraryThatLacks) {
    const Error error = error_of(CANDELA_ORPHAN_MODULE);
    EXPECT_EQ(error.fault(), Fault::machine);
    EXPECT_NE(error.line().find("Open MPI's libraries cannot be loaded"), std::string::npos) << error.line();
    EXPECT_NE(error.line().find("libcandela_absent_library.so"), std::string::npos) << error.line();
}

}  // namespace
}  // namespace candela::truth
