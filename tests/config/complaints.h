#pragma once
#include <string>
#include <vector>

#include "config/diagnostic.h"

namespace eddy {

/// A body that a scene may have anywhere.
inline const std::string kBody = "[[body]]\nradius_m = 0.01\ncentre_m = [0.08, 0.08, 0.08]\n";

/// What a loader complains about, one line each as the user sees them; empty if it loads.
template <class Load>
std::vector<std::string> complaints(Load&& load) {
    std::vector<std::string> lines;
    try {
        load();
    } catch (const ConfigError& error) {
        for (const Diagnostic& d : error.diagnostics()) lines.push_back(to_string(d));
    }
    return lines;
}

}  // namespace eddy
