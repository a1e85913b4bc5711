// Options and files may stand in any order: what follows an option's values is never taken for another of
// them. Every option of every command's help is tried, so that a new one is too.
#include <regex>
#include <sstream>
#include <vector>

#include "process.hpp"

namespace candela::test {
namespace {

struct HelpOption {
    std::string name;
    /// What the help says that it takes; empty: a flag.
    std::string takes;
};

std::vector<HelpOption> options_of(const std::string& command) {
    const std::regex line(R"(^  (?:-\w,)?(--[a-z0-9-]+)(?:,--[a-z0-9-]+)*(?: ([A-Z].*?))?(?: {2,}.*)?$)");
    std::istringstream help(run_candela("help " + command).out);
    std::vector<HelpOption> out;
    std::smatch match;
    for (std::string text; std::getline(help, text);) {
        if (std::regex_match(text, match, line) && match[1] != "--help") out.push_back({match[1], match[2]});
    }
    return out;
}

/// A value of the kind that the help names.
std::string value_for(const HelpOption& option) {
    const std::string& takes = option.takes;
    if (option.name == "--plot") return "a.svg";
    std::smatch match;
    if (std::regex_search(takes, match, std::regex(R"(\{([^,}]+))"))) return match[1];
    if (std::regex_search(takes, match, std::regex(R"( x (\d))"))) {
        std::string list = "1";
        for (int i = 1; i < std::stoi(match[1]); ++i) list += ",2";
        return list;
    }
    if (takes.find("a power of two") != std::string::npos) return "64";
    if (std::regex_search(takes, match, std::regex(R"(in \[(\S+))"))) return match[1];
    return "1";
}

struct Command {
    const char* name;
    const char* file;
    /// What it cannot be called without.
    std::vector<const char*> needs;
};

const std::vector<Command>& commands() {
    static const std::vector<Command> all{
        {"render", "absent.glb", {}},
        {"info", "absent.glb", {}},
        {"bench", "absent.glb", {}},
        {"compare", "absent.glb", {}},
        {"meter", "absent.glb", {}},
        {"bake", "absent.exr", {}},
        {"bake probes", "absent.glb", {}},
        {"bench bake", "absent.exr", {}},
        {"convert", "absent.glb", {"-o out.glb"}},
        {"light", "absent.ies", {}},
        {"env info", "absent.exr", {}},
        {"env calibrate", "absent.exr", {"--grey-card 1,1,2,2", "--value 3"}},
        {"env split", "absent.exr", {"-o out"}},
    };
    return all;
}

TEST(OptionOrder, NoOptionOfAnyCommandTakesTheFileBehindIt) {
    for (const Command& command : commands()) {
        const std::vector<HelpOption> options = options_of(command.name);
        EXPECT_GT(options.size(), 3u) << command.name;
        for (const HelpOption& option : options) {
            std::string needs;
            for (const std::string need : command.needs) {
                const bool same =
                    need.starts_with(option.name) || (option.name == "--output" && need.starts_with("-o"));
                if (!same) needs += " " + need;
            }
            const std::string call = std::string(command.name) + needs;
            const std::string given =
                option.name + (option.takes.empty() ? "" : " '" + value_for(option) + "'");
            const Outcome last = run_candela(call + " " + command.file + " " + given);
            const Outcome between = run_candela(call + " " + given + " " + command.file + " --json");
            SCOPED_TRACE(call + " " + given);
            EXPECT_NE(last.exit_code, 0);
            // A line that refers to the help is the parser's: it did not come to what the command does.
            EXPECT_EQ(last.err.find("--help)"), std::string::npos) << last.err;
            EXPECT_EQ(between.err, last.err);
            EXPECT_EQ(between.exit_code, last.exit_code);
        }
    }
}

TEST(OptionOrder, ListsAreOneWordOrAsManyWordsAsTheyHaveValues) {
    for (const char* arguments : {
             "meter --at 0,0,1 absent.glb --json",
             "meter --at 0 0 1 absent.glb --json",
             "meter --at -1 -2 -3 absent.glb --json",
             "meter --at=-1,-2,-3 absent.glb --json",
             "meter --at 0, 0, 1 absent.glb --json",
             "meter --pixel 4,5 --size 16x16 absent.glb --json",
             "render --look-from 1,2,3 --look-at 0,0,0 absent.glb -o a.png",
             "render --aov albedo,normal absent.glb -o a.exr",
             "render --aov albedo --aov normal absent.glb -o a.exr",
             "compare --modes realtime,path absent.glb --json",
             "compare --names a,b absent.exr absent.exr",
         })
        expect_one_line(run_candela(arguments), 1, "absent.");
    expect_one_line(run_candela("meter --at 0,0 absent.glb"), 2, "--at: needs 3 values and has 2");
    expect_one_line(run_candela("meter --at 1 absent.glb"), 2, "--at: needs 3 values and has 1");
    expect_one_line(run_candela("meter absent.glb --at 1,2,3,4"), 2, "--at: takes 3 values and has 4");
    expect_one_line(run_candela("render --aov albedo normal absent.glb"), 2, "absent.glb: not expected");
}

}  // namespace
}  // namespace candela::test
