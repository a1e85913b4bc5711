#version 460
#extension GL_GOOGLE_include_directive : require
#define GBUFFER_ALL_TARGETS
#include "gbuffer_targets.glsl"
