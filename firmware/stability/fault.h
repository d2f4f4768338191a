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

/// Knows which textures the last step wrote, by watching its passes go by, and writes into them.
class Faults {
  public:
    explicit Faults(gles::Gpu& gpu);
    ~Faults();
    Faults(const Faults&) = delete;
    Faults& operator=(const Faults&) = delete;

    /// A step is about to be taken; those before it are forgotten.
    void begin_step();
    /// Between two steps. What the scene does not have is left alone.
    void put(const gles::Fluid& fluid, const Fault& fault);

  private:
    std::vector<gles::Texture*> textures_of(const gles::Fluid& fluid, Fault::Place place) const;

    gles::Gpu& gpu_;
    std::vector<gles::PassRecord> passes_;
};

}  // namespace eddy::stability
