#pragma once
#include <stdexcept>

namespace eddy {

/// What the user gave is wrong: the command line, or a file it names. One line that says what, where and what
/// to write instead; becomes exit status 2 in main.cpp. Scenes and settings have ConfigError, with a line for
/// each mistake.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace eddy
