#version 460
#extension GL_GOOGLE_include_directive : require
#define GBUFFER_ALL_TARGETS
#define GBUFFER_SURFACE_NORMALS
#include "gbuffer_targets.glsl"
