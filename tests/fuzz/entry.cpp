// Where libFuzzer comes in; script/fuzz names the target.

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/config_targets.h"
#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    eddy::EDDY_FUZZ_TARGET({data, size});
    return 0;
}
