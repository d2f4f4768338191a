#pragma once

namespace eddy {

// The exponentials of the law, to the same bit on every machine. A C library takes other variants of its own on other processors
// (with fused products, where there are any), and they round otherwise in the last bit. Within two units of the last place.

/// e^-x for x >= 0: what is left of something that decays. Below 0 as at 0; of no number none.
double left_of(double x);
/// 1 - e^-x for x >= 0: what has gone, exact for small x as well.
double gone_of(double x);

}  // namespace eddy
