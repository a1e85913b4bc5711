#version 460
#extension GL_GOOGLE_include_directive : require
#define SHAPE_ALL_TARGETS
#include "shape_targets.glsl"
