#include "firmware/cost_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace eddy {
namespace {

// Lengths in ems, the size of the words. On a 24 inch screen of 1080 lines a capital is 7.3 mm high, 12 minutes of arc from
// two metres: more than twice the letters of the 6/6 line of an eye chart, which are 5.
constexpr double kEmsWide = 24.0;      // the page
constexpr double kEmsOfHeight = 30.0;  // the picture
constexpr double kEmsOfWidth = 40.0;
constexpr double kMargin = 1.0;  // around the words
constexpr double kLine = 1.4;    // from line to line
constexpr double kValues = 6.6;  // where the values of the table begin
constexpr double kBars = 9.0, kBarsEnd = 19.2;
constexpr std::size_t kMostBars = 7;  // the longest; what is left is one bar more

const glm::dvec3 kWord{0.80, 0.83, 0.88}, kValue{1.0, 1.0, 1.0}, kBar{0.36, 0.68, 0.95},
    kDimBar{0.40, 0.45, 0.52};

std::string percent(double share) {
    const double p = 100.0 * share;
    if (p < 0.01) return "less than 0.01 %";
    return p < 1.0 ? fmt::format("{:.1g} %", p) : fmt::format("{:.0f} %", p);
}

/// Two digits or more.
std::string number(double x) {
    const double size = std::abs(x);
    if (size == 0.0) return "0";
    if (!(size >= 1e-3 && size < 1e4)) return fmt::format("{:.1e}", x);
    return fmt::format("{:.{}f}", x, std::max(0, 1 - static_cast<int>(std::floor(std::log10(size)))));
}

/// A rate or a factor: whole numbers, but for small ones.
std::string rounded(double x) {
    return fmt::format("{:.{}f}", x, x < 9.95 ? 1 : 0);
}

/// What of it is no wider than that, with an ellipsis for the rest.
std::string cut_to(double ems, std::string text) {
    const gles::Font font;
    if (font.width_px(text, 1.0) <= ems) return text;
    const auto goes_on = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };  // UTF-8
    while (!text.empty() && font.width_px(text + "…", 1.0) > ems) {
        while (text.size() > 1 && goes_on(text.back())) text.pop_back();
        text.pop_back();
    }
    return text + "…";
}

/// Writes a page from its top to its bottom.
class Writer {
  public:
    explicit Writer(double em_px) : em_(em_px) {}

    void title(std::string text, double size = 1.0) {
        down(1.15 * size);
        write(kMargin, std::move(text), kValue, size);
    }
    void row(std::string word, std::string value) {
        down(kLine);
        write(kMargin, std::move(word), kWord);
        write(kValues, std::move(value), kValue);
    }
    /// A line of words alone, as much of them as there is room for.
    void note(std::string words) {
        down(kLine);
        write(kMargin, cut_to(kEmsWide - 2.0 * kMargin, std::move(words)), kWord);
    }
    void bar(std::string word, double length, std::string value, const glm::dvec3& colour) {
        down(kLine);
        write(kMargin, std::move(word), kWord);
        write(kEmsWide - kMargin, std::move(value), kValue, 1.0, gles::Align::Right);
        if (!(length > 0.0)) return;
        const double end = kBars + (kBarsEnd - kBars) * std::clamp(length, 0.0, 1.0);
        page_.boxes.push_back({.low_px = em_ * glm::dvec2(kBars, y_ - 0.72),
                               .high_px = em_ * glm::dvec2(end, y_),
                               .colour = colour});
    }
    void down(double ems) { y_ += ems; }

    gles::Page take() {
        page_.size_px = glm::ivec2(glm::round(em_ * glm::dvec2(kEmsWide, y_ + kMargin)));
        page_.boxes.insert(page_.boxes.begin(), gles::panel(glm::dvec2(0.0), glm::dvec2(page_.size_px)));
        return std::move(page_);
    }

  private:
    void write(double x, std::string text, const glm::dvec3& colour, double size = 1.0,
               gles::Align align = gles::Align::Left) {
        page_.lines.push_back({.text = std::move(text),
                               .at_px = em_ * glm::dvec2(x, y_),
                               .size_px = em_ * size,
                               .align = align,
                               .colour = colour});
    }

    double em_;
    double y_ = 0.6 * kMargin;  // of the last baseline, in ems
    gles::Page page_;
};

std::string what_is_known_of(const std::optional<double>& force_error) {
    return force_error ? fmt::format("Force within about {}", percent(*force_error))
                       : "Force error not measured yet";
}

void write_table(Writer& page, const CostFigures& f) {
    page.row("trembling", f.ripple
                              ? fmt::format("{} of it, {} N", percent(f.ripple->share), number(f.ripple->rms))
                              : "not known yet");
    page.row("grid", fmt::format("{} × {} × {} cells", f.cells.x, f.cells.y, f.cells.z));
    page.row("method", fmt::format("{}, {} a step", f.preset, f.iterations));
    page.row("rate",
             fmt::format("{} of {} steps a second", rounded(f.steps_per_s), rounded(f.target_steps_per_s)));
    std::string divergence =
        fmt::format("{} → {} 1/s", number(f.divergence_before_1_s), number(f.divergence_after_1_s));
    if (f.divergence_after_1_s > 0.0)
        divergence += fmt::format(" (÷ {})", rounded(f.divergence_before_1_s / f.divergence_after_1_s));
    page.row("max |∇·u|", f.divergence_before_1_s > 0.0 ? std::move(divergence) : "not known yet");
    page.row("quality", fmt::format("{} × down, {} × up", f.quality_down, f.quality_up));
    if (!f.quality_note.empty()) page.note(f.quality_note);
}

void write_bars(Writer& page, const CostFigures& f) {
    std::vector<CostFigures::Stage> stages = f.stages;
    std::stable_sort(stages.begin(), stages.end(), [](const auto& a, const auto& b) { return a.ms > b.ms; });
    double rest = 0.0;
    std::size_t merged = 0;
    for (; stages.size() > kMostBars + 1 || (merged > 0 && stages.size() > kMostBars); ++merged) {
        rest += stages.back().ms;
        stages.pop_back();
    }
    const int decimals = f.step_ms < 9.95 ? 2 : 1;
    const auto ms = [&](double x) { return fmt::format("{:.{}f}", x, decimals); };
    const double longest = std::max(stages.empty() ? 0.0 : stages.front().ms, rest);
    const auto share = [&](double x) { return longest > 0.0 ? x / longest : 0.0; };
    for (const CostFigures::Stage& stage : stages) page.bar(stage.name, share(stage.ms), ms(stage.ms), kBar);
    if (merged > 0) page.bar(fmt::format("{} more", merged), share(rest), ms(rest), kDimBar);
    if (f.picture_ms > 0.0) page.bar("(picture)", 0.0, ms(f.picture_ms), kDimBar);  // no part of the step
}

}  // namespace

gles::Page cost_page(const CostFigures& f, const glm::ivec2& picture_px) {
    Writer page(std::min(picture_px.y / kEmsOfHeight, picture_px.x / kEmsOfWidth));
    page.title("What does accuracy cost?", 1.3);
    page.down(0.4);
    page.title(what_is_known_of(f.force_error));
    write_table(page, f);
    page.down(0.8);
    page.title(f.stages.empty() ? "Time of a step not known yet"
                                : fmt::format("{} ms a step", rounded(f.step_ms)));
    write_bars(page, f);
    return page.take();
}

}  // namespace eddy
