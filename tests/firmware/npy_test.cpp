#include "firmware/npy.h"

#include <gmock/gmock.h>

#include <cstring>
#include <limits>

#include "firmware/input_error.h"
#include "tests/scratch_folder.h"

namespace eddy {
namespace {

using testing::StartsWith;

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

/// What read_npy() says is wrong with a file, after its name.
std::string fault_of(const std::string& file) {
    try {
        read_npy(file);
    } catch (const InputError& e) {
        const std::string message = e.what();
        EXPECT_EQ(message.substr(0, file.size() + 2), file + ": ");
        return message.substr(file.size() + 2);
    }
    return "";
}

TEST(Npy, ReadsBackWhatItWrote) {
    const ScratchFolder folder;
    const std::vector<float> values{1.0f, -0.0f, 0.1f, 1e-40f, 3.4e38f, -7.0f};
    for (const std::vector<int>& shape : {std::vector<int>{6}, {1, 2, 3, 1}}) {
        write_npy(folder / "a.npy", values, shape);
        const NpyArray got = read_npy(folder / "a.npy");
        EXPECT_EQ(got.shape, shape);
        EXPECT_EQ(got.values, values);
    }
}

TEST(Npy, ReadsTheLongerHeadersOfLaterVersions) {
    const ScratchFolder folder;
    write_npy(folder / "a.npy", std::vector<float>{4.0f, 5.0f}, {2});
    const std::string bytes = read_all(folder / "a.npy");
    const std::string later =
        std::string("\x93NUMPY\x02\x00", 8) + bytes.substr(8, 2) + std::string(2, '\0') + bytes.substr(10);
    EXPECT_EQ(read_npy(folder.write("b.npy", later)).values, (std::vector<float>{4.0f, 5.0f}));
}

TEST(Npy, SaysWhatIsWrongWithAFileAndHowToMendIt) {
    const ScratchFolder folder;
    write_npy(folder / "a.npy", std::vector<float>(6), {2, 3});
    const std::string good = read_all(folder / "a.npy");
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        return fault_of(folder.write("b.npy", text));
    };
    EXPECT_EQ(fault_of(folder / "a.npy"), "");
    EXPECT_THAT(changed("NUMPY", "mumpy"),
                StartsWith("is not a NumPy array file: write it with outputs.fields"));
    EXPECT_THAT(changed("<f4", "<f8"),
                StartsWith("holds <f8, not 32-bit floats: numpy.save(file, array.astype("));
    EXPECT_THAT(changed("'fortran_order': False", "'fortran_order': True "),
                StartsWith("is in Fortran order: "));
    EXPECT_EQ(changed("(2, 3, )", "(2, 4, )"), "is damaged: its header speaks of 8 values, but it holds 6");
    EXPECT_THAT(fault_of(folder.write("c.npy", good.substr(0, 40))), StartsWith("is damaged"));
    EXPECT_THAT(fault_of(folder.write("c.npy", "")), StartsWith("is not a NumPy array file"));
    EXPECT_EQ(fault_of(folder / "absent.npy"), "cannot be read");
}

}  // namespace
}  // namespace eddy
