#pragma once
#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "gles/atlas.h"
#include "gles/fluid/setup.h"

namespace eddy::gles {

/// Radius of the ball around the body's centre that holds it [m].
double bounding_radius_m(const Shape& shape);

/// A ball that holds the body, in the body's frame. Around its centre; but a mesh, whose origin may be anywhere, has it
/// around the middle of its box, so that nothing hangs on where its file has the origin.
struct Ball {
    glm::dvec3 centre_m;
    double radius_m;
};
Ball bounding_ball(const Shape& shape);
/// Where the middle of that ball is in the tank [m].
glm::dvec3 middle_m(const Shape& shape, const BodyState& state);

/// The least width of the solid, between parallel surfaces that are far apart from other ones [m]; 0 where it is not known.
double thickness_m(const Shape& shape);

/// The smallest box along the tank's axes that holds a shape, from the body's centre [m].
struct Extent {
    glm::dvec3 low, high;
};
Extent extent(const Shape& shape, const glm::dquat& orientation);
/// Where the centre of a body may be in a tank of that size so that it stays gap_m from the walls; along an axis with less
/// room, only in the middle.
Extent room_for_centre(const Extent& body, const glm::dvec3& size_m, double gap_m);

/// The cells in which the body's presence can be noticed: its extent and two cells around it, inside the
/// grid; for a body turned inside out, the whole grid.
Box body_box(const BodySetup& body, const BodyState& state, double cell_m, const glm::ivec3& cells);
/// The most cells that box can have each way, whatever the state.
glm::ivec3 largest_body_box(const BodySetup& body, double cell_m, const glm::ivec3& cells);

/// In the body's frame [m].
std::array<glm::dvec3, 4> corners_m(const Tetrahedron& tetrahedron);

}  // namespace eddy::gles
