#include "firmware/npy.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "tests/scratch_folder.h"

namespace eddy {
namespace {

// The format is NumPy's: numpy.lib.format, version 1.0.

std::size_t header_length(const std::string& bytes) {
    return static_cast<unsigned char>(bytes[8]) + 256u * static_cast<unsigned char>(bytes[9]);
}

TEST(Npy, BeginsWithMagicVersionAndAHeaderThatAlignsTheData) {
    const ScratchFolder folder;
    for (const std::vector<int>& shape : {std::vector<int>{6}, {2, 3}, {1, 2, 3}, {3, 2, 1, 1}}) {
        write_npy(folder / "a.npy", std::vector<float>(6), shape);
        const std::string bytes = read_all(folder / "a.npy");
        EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
        const std::size_t start = 10 + header_length(bytes);
        EXPECT_EQ(start % 64, 0u);
        EXPECT_EQ(bytes[start - 1], '\n');
        EXPECT_EQ(bytes.size(), start + 6 * sizeof(float));
    }
}

TEST(Npy, SaysItsShapeAsAPythonTuple) {
    const ScratchFolder folder;
    const auto header = [&](const std::vector<int>& shape) {
        write_npy(folder / "a.npy", std::vector<float>(6), shape);
        const std::string bytes = read_all(folder / "a.npy");
        return bytes.substr(10, bytes.find('}') - 9);
    };
    EXPECT_EQ(header({6}), "{'descr': '<f4', 'fortran_order': False, 'shape': (6, ), }");
    EXPECT_EQ(header({1, 2, 3}), "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2, 3, ), }");
}

TEST(Npy, HoldsTheValuesBitForBit) {
    const ScratchFolder folder;
    const std::vector<float> values{0.0f,
                                    -0.0f,
                                    0.1f,
                                    std::numeric_limits<float>::infinity(),
                                    std::numeric_limits<float>::denorm_min(),
                                    -3.4e38f};
    write_npy(folder / "a.npy", values, {2, 3});
    const std::string bytes = read_all(folder / "a.npy");
    EXPECT_EQ(std::memcmp(bytes.data() + 10 + header_length(bytes), values.data(), 24), 0);
}

}  // namespace
}  // namespace eddy
