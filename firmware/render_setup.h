#pragma once
#include "config/scene.h"
#include "gles/render/renderer.h"

namespace eddy {

/// The picture that a scene asks for.
gles::RenderSetup render_setup(const Scene& scene);

}  // namespace eddy
