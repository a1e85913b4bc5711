#pragma once

#include <string>

namespace candela::app {

/// `candela bake lobes`: fits shading/stretched_reflection.glsl's polynomials and prints them, with what they
/// were fitted to and how good they are. output: a file for the same as JSON; empty: none. json: print the
/// JSON.
int bake_lobes(const std::string& output, bool json);

}  // namespace candela::app
