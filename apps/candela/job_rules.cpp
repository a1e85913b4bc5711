#include "candela/scene/error.hpp"
#include "job.hpp"
#include "option_rules.hpp"
#include "sky_option.hpp"

namespace candela::app {
namespace {

const std::vector<std::string> kReading{"--env-layout", "--env-cube", "--env-layer", "--env-negative"};
const std::vector<std::string> kEnvironment{"--env-scale",  "--env-lux",      "--env-rotate", "--env-visible",
                                            "--env-hidden", "--env-keep-sun", "--env-layout", "--env-cube",
                                            "--env-layer",  "--env-negative"};

}  // namespace

void check_environment_reading(const CLI::App& command, const std::string& name) {
    if (sky_of_option(name)) refuse_without_effect(command, kReading, "on a sky: it is computed, not read");
    if (name == "studio") refuse_without_effect(command, kReading, "on the studio: it is not a file");
}

void check_environment_options(const CLI::App& command, const JobOptions& o) {
    refuse_together(command, {"--env-visible", "--env-hidden"});
    refuse_together(command, {"--env-scale", "--env-lux"});
    if (o.environment == "none") refuse_without_effect(command, kEnvironment, "with --env none");
    if (o.environment.empty())
        refuse_without_effect(command, kReading, "without --env: a stage says how its own file is read",
                              "--env FILE, or environment/layout, cube, layer and negative of the stage");
    check_environment_reading(command, o.environment);
    if (sky_of_option(o.environment))
        refuse_without_effect(command, {"--env-keep-sun"}, "on a sky, whose sun is a light of its own");
    if (o.environment == "studio") refuse_without_effect(command, {"--env-keep-sun"}, "on the studio");
}

void refuse_options_of_no_environment(const JobOptions& o, const std::string& where) {
    const char* option = o.env_lux          ? "--env-lux"
                         : o.env_scale      ? "--env-scale"
                         : o.env_rotate_deg ? "--env-rotate"
                         : o.env_visible    ? (*o.env_visible ? "--env-visible" : "--env-hidden")
                         : o.env_keep_sun   ? "--env-keep-sun"
                                            : nullptr;
    if (option != nullptr)
        throw Error(Fault::usage, "has no effect: " + where + " has no environment", option,
                    "--env FILE, sky or studio");
}

void check_picture_options(const CLI::App& command) {
    refuse_together(command, {"--size", "--width"});
    refuse_together(command, {"--size", "--height"});
    refuse_together(command, {"--camera", "--look-from"});
    refuse_together(command, {"--camera", "--look-at"});
    refuse_together(command, {"--ev100", "--auto-exposure"});
    for (const char* how : {"--ev100", "--auto-exposure"}) {
        refuse_together(command, {how, "--shutter"});
        refuse_together(command, {how, "--iso"});
    }
    refuse_together(command, {"--auto-exposure", "--aperture"});
    // A lens has an aperture whatever the exposure is.
    if (!given(command, "--depth-of-field")) refuse_together(command, {"--ev100", "--aperture"});
}

void check_shadow_options(const CLI::App& command, const ShadowRequestOptions& o, const std::string& mode) {
    if (mode != "realtime")
        refuse_without_effect(command, {"--shadow-atlas"}, "in the mode " + mode, "--mode realtime");
    if (o.way == "none") refuse_together(command, {"--shadows", "--shadow-atlas"});
}

}  // namespace candela::app
