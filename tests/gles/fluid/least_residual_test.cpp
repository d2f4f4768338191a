#include "gles/fluid/least_residual.h"

#include <cmath>
#include <limits>
#include <random>

#include "gles/grid_io.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

using Values = std::vector<float>;

double dot(const Values& a, const Values& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * static_cast<double>(b[i]);
    return sum;
}

double length(const Values& a) {
    return std::sqrt(dot(a, a));
}

Values minus(Values a, const Values& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
    return a;
}

/// The corrections proposed for  A phi = b  are noise, or what a test makes of it. A is diagonal, from 1 to 5; the last slab of
/// the grid is half padding.
class LeastResidualTest : public GlTest {
  protected:
    const glm::ivec3 n{7, 5, 6};
    std::mt19937 random{5};
    LeastResidual least{gpu, n};
    Values b = noise();
    Field<Cells4> phi = upload(Values(b.size())), r = upload(b);

    Values noise() {
        std::uniform_real_distribution<float> value(-1.0f, 1.0f);
        Values v(static_cast<std::size_t>(n.x * n.y * n.z));
        for (float& one : v) one = value(random);
        return v;
    }
    static Values times_a(Values v) {
        for (std::size_t i = 0; i < v.size(); ++i) v[i] *= static_cast<float>(1 + i % 5);
        return v;
    }
    Field<Cells4> upload(const Values& v) {
        Field<Cells4> field(gpu, n, Format::RGBA32F);
        field.texture().upload(&pack_four(v, field.layout(), n)[0].x);
        return field;
    }
    Values download(const Field<Cells4>& field) const {
        return unpack_four(field.texture().download(), field.layout(), n);
    }
    void correct(const Values& z) {
        least.correct(phi, r, upload(z), upload(minus(download(r), times_a(z))));
    }
    /// How far what is called the residual is from being it.
    double drift() const { return length(minus(download(r), minus(b, times_a(download(phi))))); }
};

TEST_F(LeastResidualTest, NeverGrowsHoweverWrongTheCorrectionsAre) {
    double before = length(b);
    for (const float factor : {1.0f, -1.0f, 1e4f, 1e-4f, -30.0f, 2.0f}) {
        Values z = noise();
        for (float& one : z) one *= factor;
        correct(z);
        const double after = length(download(r));
        EXPECT_LT(after, before) << factor;
        EXPECT_LT(drift(), 1e-5 * length(b)) << factor;
        before = after;
    }
}

TEST_F(LeastResidualTest, IsOrthogonalToWhatTheLastTwoCorrectionsTookOfIt) {
    Values before = b, taken_last;
    for (int i = 0; i < 4; ++i) {
        correct(noise());
        const Values after = download(r), taken = minus(before, after);
        const double scale = length(after) * length(taken);
        EXPECT_LT(std::abs(dot(after, taken)), 1e-5 * scale) << i;
        if (i > 0) {
            EXPECT_LT(std::abs(dot(after, taken_last)), 1e-5 * length(after) * length(taken_last)) << i;
        }
        before = after;
        taken_last = taken;
    }
}

TEST_F(LeastResidualTest, TakesTwoCorrectionsAsTheBestOfTheirMixtures) {
    // b lies in what two directions can take away: the second correction leaves nothing.
    const Values first = noise(), second = noise();
    for (std::size_t i = 0; i < b.size(); ++i) b[i] = times_a(first)[i] - 2.0f * times_a(second)[i];
    r = upload(b);
    correct(first);
    EXPECT_GT(length(download(r)), 0.1 * length(b));
    correct(second);
    EXPECT_LT(length(download(r)), 1e-5 * length(b));
}

TEST_F(LeastResidualTest, TakesNothingAlongTheLastDirectionAndKeepsIt) {
    Values z = noise();
    correct(z);
    const Values was = download(phi), left = download(r);
    for (float& one : z) one *= -0.37f;
    correct(z);
    EXPECT_EQ(download(phi), was);
    EXPECT_EQ(download(r), left);
    correct(noise());
    EXPECT_LT(length(download(r)), length(left));
    EXPECT_LT(std::abs(dot(download(r), minus(b, left))), 1e-5 * length(left) * length(b))
        << "it forgot the direction before";
    EXPECT_LT(drift(), 1e-5 * length(b)) << "it took rounding for a direction";
}

TEST_F(LeastResidualTest, LeavesASolutionAlone) {
    phi = upload(b);
    b = times_a(b);
    const Values solution = download(phi);
    r = upload(Values(b.size()));
    correct(Values(b.size()));
    correct(noise());
    EXPECT_EQ(download(phi), solution);
    EXPECT_EQ(length(download(r)), 0.0);
}

TEST_F(LeastResidualTest, DoesNotCountThePaddingOfTheLastSlab) {
    // r and r_z are the same there, whatever they are (poisson.glsl), as A z is nothing.
    const Values z = noise();
    const auto with_padding = [&](const Values& v, float padding) {
        Field<Cells4> field(gpu, n, Format::RGBA32F);
        std::vector<glm::vec4> texels = pack_four(v, field.layout(), n);
        for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x) {
                const glm::ivec2 t = field.layout().texel({x, y, 1});
                glm::vec4& last = texels[static_cast<std::size_t>(t.y * field.layout().texels().x + t.x)];
                last.z = last.w = padding;
            }
        field.texture().upload(&texels[0].x);
        return field;
    };
    const auto corrected = [&](float padding) {
        least.restart();
        phi = upload(Values(b.size()));
        r = with_padding(b, padding);
        least.correct(phi, r, with_padding(z, padding), with_padding(minus(b, times_a(z)), padding));
        return download(phi);
    };
    const Values clean = corrected(0.0f);
    EXPECT_EQ(corrected(1e3f), clean);
    EXPECT_GT(length(clean), 0.0);
}

TEST_F(LeastResidualTest, ForgetsTheLastDirectionWhenAnotherEquationFollows) {
    const Values first = noise();
    Values z = noise();
    for (std::size_t i = 0; i < z.size(); ++i) z[i] += 2.0f * first[i];
    correct(first);
    least.restart();
    const Values left = download(r);
    correct(z);
    // Alone, z takes (A z . r) / |A z| of r; without what it has of the direction before it would take more.
    const Values az = times_a(z);
    const double taken = dot(az, left) / length(az);
    EXPECT_NEAR(length(download(r)), std::sqrt(dot(left, left) - taken * taken), 1e-5 * length(left));
}

TEST_F(LeastResidualTest, OfSomethingThatIsNoNumberLeavesAllOthersAsTheyWere) {
    correct(noise());
    const Values was = download(phi);
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Values broken = download(r);
        const Values whole = broken;
        broken[17] = bad;
        r = upload(broken);
        // A cycle carries it to all coarse cells, and so everywhere.
        least.correct(phi, r, upload(Values(b.size(), bad)), upload(Values(b.size(), bad)));
        EXPECT_EQ(download(phi), was) << bad;
        r = upload(whole);
    }
    const double before = length(download(r));
    correct(noise());
    EXPECT_LT(length(download(r)), before) << "and it goes on";
    EXPECT_LT(drift(), 1e-5 * length(b));
}

}  // namespace
}  // namespace eddy::gles
