#pragma once
#include <string>

#include "config/scene.h"

namespace eddy {

/// A ball in the hand, in a tank that has only one grid of those that tuning tries: 13 cells, or multiples of 13, along its
/// longest side.
inline Scene small_tank(const std::string& solver = "", const std::string& cells = "[13, 5, 5]") {
    return read_scene("[tank]\nsize_m = [0.13, 0.05, 0.05]\ncells = " + cells + "\n[solver]\n" + solver +
                          "[[body]]\nradius_m = 0.012\nmotion = \"held\"\n"
                          "[render]\nwidth_px = 32\nheight_px = 24\n",
                      "test.toml")
        .scene;
}

}  // namespace eddy
