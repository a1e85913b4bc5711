#pragma once

#include "candela/measure/lit_scene.hpp"

/// Balls of rising roughness with Disney's diffuse under an area light: the BRDF at one direction times the
/// light's illuminance, against the integral over the light.
namespace candela::measure {

/// A piece of the light: the integral is a sum over these.
struct LightPiece {
    glm::dvec3 position;
    glm::dvec3 shines;  ///< unit
    double area = 0.0;
};

struct DisneyTechnique {
    std::string label;
    std::string name;  ///< of the direction's function in shading/
    std::function<glm::dvec3(const glm::dvec3& normal, const glm::dvec3& position)> direction;
    double flip_at_most = 0.0;
    std::function<double()> cost_ns;
};

struct DisneyFigure {
    std::string title;
    LitScene scene;  ///< its balls are replaced
    Illuminance illuminance;
    std::vector<LightPiece> pieces;
    std::vector<DisneyTechnique> techniques;
    double white = 1.0;
};

/// Adds the picture, each technique's mean FLIP, and its row: the error of the luminance per illuminance,
/// relative to the truth, over the balls.
void add_disney_figure(Findings& out, DisneyFigure figure);

}  // namespace candela::measure
