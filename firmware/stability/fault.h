#pragma once
#include <vector>

#include "gles/fluid/fluid.h"
#include "gles/gpu.h"

namespace eddy::stability {

/// A number that gets into a texture though nobody has computed it: memory that has lost a bit, a driver's fault.
struct Fault {
    enum class Place { Velocity, Pressure, Smoke, Temperature, Fractions };
    Place place = Place::Velocity;
    float value = 0.0f;
    enum class Extent {
        Texel,         ///< one, a quarter of the tank from its middle
        Everywhere,    ///< all of them
        Checkerboard,  ///< all of them, with changing sign from cell to cell; fields of cells only
        Garbage        ///< all of them, with numbers between plus and minus the value that follow no pattern
    } extent = Extent::Texel;
};

/// Writes into what lives in a fluid from step to step; and into the shares of its solids, which it knows by watching the passes
/// of steps go by.
class Faults {
  public:
    explicit Faults(gles::Gpu& gpu);
    ~Faults();
    Faults(const Faults&) = delete;
    Faults& operator=(const Faults&) = delete;

    /// A step is about to be taken.
    void begin_step(const gles::Fluid& fluid);
    /// Between two steps. What the scene does not have, smoke, heat or solids, is left alone; a fault that misses what the fluid
    /// has is a std::logic_error.
    void put(const gles::Fluid& fluid, const Fault& fault);

  private:
    std::vector<gles::Texture*> fractions_of(const gles::Fluid& fluid) const;
    std::vector<gles::Texture*> textures_of(const gles::Fluid& fluid, Fault::Place place) const;

    gles::Gpu& gpu_;
    std::vector<gles::PassRecord> passes_;  ///< since the last step began
    std::vector<gles::Texture*>
        fractions_;  ///< of the last step before it that drew them: one that is refused draws nothing
};

}  // namespace eddy::stability
