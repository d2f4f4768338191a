#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "config/scene.h"
#include "tests/config/everything.h"
#include "tests/config/whole_schema.h"

namespace eddy {
namespace {

// Scraps that are likelier than random bytes to get past the TOML parser.
const std::vector<std::string> kScraps = {"[",
                                          "]",
                                          "[[",
                                          "]]",
                                          "=",
                                          "\"",
                                          "\n",
                                          "nan",
                                          "-1",
                                          "1e400",
                                          "{",
                                          "}",
                                          ".",
                                          "#",
                                          ",",
                                          "true",
                                          "[body]",
                                          "[[body]]",
                                          "\\u0000",
                                          "'''",
                                          "\0",
                                          "\xff",
                                          "0",
                                          "9223372036854775807",
                                          "\"held\"",
                                          "\"\"",
                                          "1979-05-27",
                                          "name = \"ball\"\n",
                                          "[smoke]\n",
                                          "motion = \"prescribed\"\n",
                                          "[tank.walls]\n",
                                          "\"x\"",
                                          "\"sin(\"",
                                          "\"open\"",
                                          "{ kind = \"inflow\" }",
                                          "shape = \"mesh\"\n",
                                          "[imposed]\n",
                                          "[[probe]]\n"};

class Mutator {
  public:
    explicit Mutator(unsigned seed) : random_(seed) {}

    std::string mutated(std::string text) {
        for (std::size_t slips = 1 + below(4); slips > 0; --slips) slip(text);
        return text;
    }

  private:
    std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }

    void slip(std::string& text) {
        const std::size_t at = below(text.size() + 1);
        const std::size_t length = std::min(1 + below(12), text.size() - at);
        switch (below(8)) {
            case 0:
                text.erase(at, length);
                break;
            case 1:
                text.insert(at, text.substr(below(text.size() + 1), 1 + below(40)));
                break;
            case 2:
                text.insert(at, kScraps[below(kScraps.size())]);
                break;
            case 3:
                text.replace(at, length, kScraps[below(kScraps.size())]);
                break;
            case 4:
                text.insert(at, 1, static_cast<char>(below(256)));
                break;
            default:
                change_digit(text, at);
                break;
        }
    }

    void change_digit(std::string& text, std::size_t from) {
        const std::size_t at = text.find_first_of("0123456789", from);
        if (at != std::string::npos) text[at] = static_cast<char>('0' + below(10));
    }

    std::mt19937 random_;
};

// A scene either loads, and then prints to something that reads back the same, or is refused with places
// inside it.
template <class Read>
void expect_slips_load_or_are_refused(const std::vector<std::string>& seeds, int times, const Read& read) {
    constexpr unsigned kSeed = 2009;
    Mutator mutator(kSeed);
    int loaded = 0, refused = 0;
    for (int i = 0; i < times; ++i) {
        SCOPED_TRACE(testing::Message() << "slip " << i << " of seed " << kSeed);
        const std::string text = mutator.mutated(seeds[static_cast<std::size_t>(i) % seeds.size()]);
        try {
            const Scene scene = read(text).scene;
            ++loaded;
            if (i % 4 == 0) {
                ASSERT_EQ(read(print_scene(scene)).scene, scene) << text;
            }
        } catch (const ConfigError& error) {
            ++refused;
            const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
            for (const Diagnostic& d : error.diagnostics()) {
                ASSERT_EQ(d.file, "s.toml") << text;
                ASSERT_GE(d.line, 1) << text;
                ASSERT_LE(d.line, lines + 1) << text;
                ASSERT_FALSE(d.message.empty()) << text;
            }
        }
    }
    // Both outcomes must be common, or the test would look at one side only.
    EXPECT_GT(loaded, times / 20);
    EXPECT_GT(refused, times / 20);
}

TEST(SceneFuzz, TwentyThousandSlipsEitherLoadOrAreRefused) {
    std::vector<std::string> seeds;
    for (const std::string_view name : shipped_scenes())
        seeds.push_back(print_scene(load_scene(std::string(name)).scene));
    expect_slips_load_or_are_refused(seeds, 20000,
                                     [](const std::string& text) { return read_scene(text, "s.toml"); });
}

TEST(SceneFuzz, SlipsInScenesWithEveryKeyEitherLoadOrAreRefused) {
    const auto all = scenes_with_every_key(testing::TempDir() + "eddy_fuzz");
    std::vector<std::string> seeds(all.begin(), all.end());
    for (const std::string& text : all) seeds.push_back(print_scene(read_whole(text).scene));
    expect_slips_load_or_are_refused(seeds, 10000, read_whole);
}

TEST(SceneFuzz, OverridesEitherApplyOrAreRefused) {
    const std::string scene = print_scene(load_scene("bench").scene);
    const std::vector<std::string> seeds = {"solver.dt_s=0.01", "body.0.centre_m=[0.1, 0.1, 0.1]",
                                            "body.ball.name=\"x\"", "smoke={}", "tank.walls=\"slip\""};
    Mutator mutator(11);
    for (int i = 0; i < 2000; ++i) {
        const std::vector<std::string> overrides = {
            mutator.mutated(seeds[static_cast<std::size_t>(i) % seeds.size()])};
        try {
            read_scene(scene, "s.toml", overrides);
        } catch (const ConfigError&) {
            continue;
        }
    }
}

}  // namespace
}  // namespace eddy
