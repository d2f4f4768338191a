#pragma once
#include <functional>
#include <string>

#include "firmware/input_error.h"

namespace eddy::stability {

/// What an InputError says, or "nothing".
inline std::string complaint_about(const std::function<void()>& act) {
    try {
        act();
    } catch (const InputError& e) {
        return e.what();
    }
    return "nothing";
}

}  // namespace eddy::stability
