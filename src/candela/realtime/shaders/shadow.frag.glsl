#version 460
// Depth is all there is. A shader of its own, so that surfaces without a mask need no material.
void main() {}
