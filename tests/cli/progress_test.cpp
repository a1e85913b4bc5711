// What a person at a terminal sees while a command works, by a pseudo-terminal; and what a script does not
// see.
#include <pty.h>

#include <regex>
#include <vector>

#include "demo_scenes.hpp"
#include "process.hpp"

namespace candela::test {
namespace {

/// Everything that the command writes to a terminal of 120 columns, up to its end.
std::string on_a_terminal(const std::vector<std::string>& arguments) {
    std::vector<std::string> words{CANDELA_BINARY};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    winsize size{};
    size.ws_row = 40;
    size.ws_col = 120;
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
    if (child == 0) {
        execv(argv[0], argv.data());
        _exit(127);
    }
    EXPECT_GT(child, 0);
    std::string out;
    char bytes[4096];
    // The terminal of a program that ended gives an error and not an end.
    for (ssize_t n = read(terminal, bytes, sizeof(bytes)); n > 0; n = read(terminal, bytes, sizeof(bytes)))
        out.append(bytes, static_cast<std::size_t>(n));
    int status = 0;
    waitpid(child, &status, 0);
    close(terminal);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << out;
    return out;
}

bool has(const std::string& text, const char* pattern) {
    return std::regex_search(text, std::regex(pattern));
}

const TemporaryFolder& room() {
    static const TemporaryFolder folder;
    static const bool written = (scenes::write_room(folder.path()), true);
    (void)written;
    return folder;
}

TEST(ProgressLine, APathTracedPictureShowsHowFarAndHowLong) {
    const TemporaryFolder out;
    const std::string file = out / "a.png";
    const std::string shown = on_a_terminal({"render", room() / "cornell_room.glb", "--env", "none", "--mode",
                                             "path", "--size", "320x180", "--time-limit", "2", "-o", file});
    EXPECT_TRUE(has(shown, R"(candela: rendering by path: \d+ %, \d+ s, \d+ s left, \d+ samples)")) << shown;
    // The line is taken back before the last one is written.
    const std::size_t wrote = shown.find("candela: wrote " + file);
    ASSERT_NE(wrote, std::string::npos) << shown;
    EXPECT_GT(shown.rfind("\033[K", wrote), shown.rfind(" left", wrote)) << shown;
}

TEST(ProgressLine, TheIntegratorShowsItsSamples) {
    const TemporaryFolder out;
    const std::string shown =
        on_a_terminal({"render", room() / "cornell_room.glb", "--env", "none", "--mode", "integrate",
                       "--size", "320x180", "--samples", "16", "-o", out / "a.png"});
    EXPECT_TRUE(has(shown, R"(candela: rendering by integrate: \d+ %, \d+ s, \d+ s left)")) << shown;
}

TEST(ProgressLine, APipeSeesNothingOfIt) {
    const TemporaryFolder out;
    const Outcome outcome =
        run_candela("render " + (room() / "cornell_room.glb") +
                    " --env none --mode path --size 160x90 --time-limit 1 -o " + (out / "a.png"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find('\r'), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find(" left"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("candela: wrote ", 0), 0u) << outcome.err;
    EXPECT_EQ(lines(outcome.err), 1u) << outcome.err;
}

// One line says what was written where, whatever the command.
TEST(ProgressLine, EveryCommandSaysWhatItWrote) {
    const TemporaryFolder out;
    const auto wrote = [&](const std::string& command, const std::string& file) {
        const Outcome outcome = run_candela(command);
        EXPECT_EQ(outcome.exit_code, 0) << command << outcome.err;
        EXPECT_NE(outcome.err.find("candela: wrote " + (out / file)), std::string::npos)
            << command << ": " << outcome.err;
        EXPECT_TRUE(std::filesystem::exists(out / file)) << command;
    };
    spit(out / "lamp.ies",
         "IESNA:LM-63-2002\n[TEST] 1\n[TESTLAB] none\n[ISSUEDATE] 2026\n[MANUFAC] none\nTILT=NONE\n"
         "1 1000 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n100 50 0\n");
    wrote("light " + (out / "lamp.ies") + " --plot " + (out / "web.svg"), "web.svg");
    wrote("env calibrate studio --grey-card 0,0,8,8 --value 100 -o " + (out / "c.exr"), "c.exr");
    wrote("env split studio -o " + (out / "split"), "split");
    wrote("bake dfg --dfg-size 8 -o " + (out / "dfg.exr"), "dfg.exr");
    wrote("bake studio --size 16 --irradiance-size 4 -o " + (out / "baked"), "baked");
    wrote("convert " + (room() / "cornell_room.glb") + " -o " + (out / "room.glb"), "room.glb");
    wrote("validate --only karis2013_figure4 -o " + (out / "validation"), "validation/index.html");
}

}  // namespace
}  // namespace candela::test
