#pragma once
#include <string>

#include "gles/context.h"

namespace eddy::gles {

/// What a GlError says that f throws; nothing if it throws none.
template <class F>
std::string refusal(F f) {
    try {
        f();
    } catch (const GlError& e) {
        return e.what();
    }
    return "";
}

}  // namespace eddy::gles
