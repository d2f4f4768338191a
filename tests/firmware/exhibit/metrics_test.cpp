#include "firmware/exhibit/metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "tests/scratch_folder.h"

namespace eddy {
namespace {

/// A sample of the exposition format.
struct Sample {
    std::map<std::string, std::string> labels;
    double value = 0.0;
};

/// Reads the format as its specification has it; fails the test at what it does not allow.
class Parser {
  public:
    explicit Parser(const std::string& text) {
        EXPECT_TRUE(text.ends_with('\n')) << "the last line must end";
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);)
            line.starts_with('#') ? comment(line) : sample(line);
        for (const auto& [name, type] : types_)
            EXPECT_TRUE(seen_.contains(name)) << name << " has a type and no sample";
    }
    double value(const std::string& name, const std::map<std::string, std::string>& labels = {}) const {
        const auto all = samples_.find(name);
        if (all != samples_.end())
            for (const Sample& s : all->second)
                if (s.labels == labels) return s.value;
        ADD_FAILURE() << "no sample " << name;
        return 0.0;
    }
    const std::vector<Sample>& all(const std::string& name) const { return samples_.at(name); }
    bool has(const std::string& name) const { return samples_.contains(name); }
    std::string type(const std::string& name) const {
        return types_.contains(name) ? types_.at(name) : "none";
    }
    const std::map<std::string, std::string>& types() const { return types_; }

  private:
    void comment(const std::string& line) {
        static const std::regex kHelp("# HELP ([a-zA-Z_:][a-zA-Z0-9_:]*) .+");
        static const std::regex kType("# TYPE ([a-zA-Z_:][a-zA-Z0-9_:]*) (counter|gauge|histogram)");
        std::smatch m;
        if (std::regex_match(line, m, kHelp)) {
            EXPECT_TRUE(helps_.insert(m[1]).second) << "twice: " << line;
            EXPECT_FALSE(seen_.contains(m[1])) << "after its samples: " << line;
        } else if (std::regex_match(line, m, kType)) {
            EXPECT_TRUE(types_.emplace(m[1], m[2]).second) << "twice: " << line;
            EXPECT_TRUE(helps_.contains(m[1])) << "no help before " << line;
            current_ = m[1];
        } else {
            ADD_FAILURE() << line;
        }
    }
    void sample(const std::string& line) {
        static const std::regex kSample(
            R"re(([a-zA-Z_:][a-zA-Z0-9_:]*)(\{(.*)\})? (NaN|[+-]Inf|[-+0-9.e]+))re");
        static const std::regex kLabel(R"re(([a-zA-Z_][a-zA-Z0-9_]*)="((?:[^"\\\n]|\\["\\n])*)"(,|$))re");
        std::smatch m;
        ASSERT_TRUE(std::regex_match(line, m, kSample)) << line;
        const std::string name = m[1], labels = m[3], number = m[4];
        const bool belongs =
            name == current_ || (types_[current_] == "histogram" && name.starts_with(current_ + "_"));
        EXPECT_TRUE(belongs) << "samples of a metric stand together, after its type: " << line;
        seen_.insert(current_);
        Sample s;
        std::size_t read = 0;
        for (std::sregex_iterator i(labels.begin(), labels.end(), kLabel), end; i != end; ++i) {
            EXPECT_TRUE(s.labels.emplace((*i)[1], (*i)[2]).second) << line;
            read += static_cast<std::size_t>(i->length());
        }
        EXPECT_EQ(read, labels.size()) << line;
        s.value = number == "NaN"    ? std::nan("")
                  : number == "+Inf" ? std::numeric_limits<double>::infinity()
                  : number == "-Inf" ? -std::numeric_limits<double>::infinity()
                                     : std::stod(number);
        samples_[name].push_back(s);
    }
    std::set<std::string> helps_, seen_;
    std::map<std::string, std::string> types_;
    std::map<std::string, std::vector<Sample>> samples_;
    std::string current_;
};

Status busy() {
    Status s;
    s.scene = "a \"jet\" \\ more";
    s.uptime_s = 3600.5;
    s.loop.late = 7;
    s.loop.gate.clamped = 3;
    s.loop.device_counters.lost = 2;
    s.guards.step_refused = 5;
    s.show.placed = 11;
    s.vital_signs.state = ExhibitState::InUse;
    s.vital_signs.total.visits = 123456;
    s.vital_signs.total.dwell_s = 99.5;
    s.vital_signs.config_good = false;
    s.vital_signs.config_taken_at_s = 1795517000;
    s.vital_signs.gpu_resets = 1;
    s.vital_signs.disk_errors = 2;
    for (const double frame_s : {0.001, 0.02, 0.02, 5.0}) s.vital_signs.frames.add(Seconds(frame_s));
    return s;
}

TEST(Metrics, CanBeReadByPrometheus) {
    const Parser metrics(metrics_text(busy()));
    EXPECT_EQ(metrics.value("exhibit_up"), 1.0);
    EXPECT_EQ(metrics.value("exhibit_haptic_tick_late_total"), 7.0);
    EXPECT_EQ(metrics.value("exhibit_force_clamp_total"), 3.0);
    EXPECT_EQ(metrics.value("exhibit_usb_reconnect_total"), 2.0);
    EXPECT_EQ(metrics.value("exhibit_gpu_reset_total"), 1.0);
    EXPECT_EQ(metrics.value("exhibit_disk_error_total"), 2.0);
    EXPECT_EQ(metrics.value("exhibit_guard_total", {{"guard", "step_refused"}}), 5.0);
    EXPECT_EQ(metrics.value("exhibit_guard_total", {{"guard", "hand_placed"}}), 11.0);
    EXPECT_EQ(metrics.value("exhibit_config_last_reload_successful"), 0.0);
    EXPECT_EQ(metrics.value("exhibit_config_last_reload_success_timestamp_seconds"), 1795517000.0);
    EXPECT_EQ(metrics.value("exhibit_visits_total"), 123456.0);
    EXPECT_EQ(metrics.value("exhibit_dwell_seconds_total"), 99.5);
    EXPECT_EQ(metrics.value("exhibit_clock_synchronised"), 0.0);
    EXPECT_EQ(metrics.all("exhibit_info")[0].labels.at("scene"), R"(a \"jet\" \\ more)");
}

TEST(Metrics, AreInOneState) {
    const Parser metrics(metrics_text(busy()));
    double sum = 0.0;
    for (const Sample& s : metrics.all("exhibit_state")) sum += s.value;
    EXPECT_EQ(sum, 1.0);
    EXPECT_EQ(metrics.value("exhibit_state", {{"state", "in_use"}}), 1.0);
}

TEST(Metrics, CountersAreCalledTotal) {
    const Parser metrics(metrics_text(busy()));
    for (const auto& [name, type] : metrics.types())
        EXPECT_EQ(name.ends_with("_total"), type == "counter") << name;
}

TEST(Metrics, FramesAreAHistogram) {
    const Parser metrics(metrics_text(busy()));
    EXPECT_EQ(metrics.type("exhibit_frame_seconds"), "histogram");
    double before = 0.0;
    for (const Sample& bucket : metrics.all("exhibit_frame_seconds_bucket")) {
        EXPECT_GE(bucket.value, before);
        before = bucket.value;
    }
    EXPECT_EQ(metrics.value("exhibit_frame_seconds_bucket", {{"le", "0.01"}}), 1.0);
    EXPECT_EQ(metrics.value("exhibit_frame_seconds_bucket", {{"le", "0.025"}}), 3.0);
    EXPECT_EQ(metrics.value("exhibit_frame_seconds_bucket", {{"le", "3"}}), 3.0);
    EXPECT_EQ(metrics.value("exhibit_frame_seconds_bucket", {{"le", "+Inf"}}), 4.0);
    EXPECT_EQ(metrics.value("exhibit_frame_seconds_count"), 4.0);
    EXPECT_NEAR(metrics.value("exhibit_frame_seconds_sum"), 5.041, 1e-9);
}

TEST(Metrics, SayNoTemperatureWhereThereIsNoThermometer) {
    Status s;
    EXPECT_FALSE(Parser(metrics_text(s)).has("exhibit_temperature_celsius"));
    s.vital_signs.temperature_c = 61.5;
    EXPECT_EQ(Parser(metrics_text(s)).value("exhibit_temperature_celsius"), 61.5);
}

TEST(Metrics, NumbersThatAreNoneAreWrittenAsPrometheusHasThem) {
    Status s;
    s.uptime_s = std::numeric_limits<double>::infinity();
    s.cost.steps_per_s = std::nan("");
    const Parser metrics(metrics_text(s));
    EXPECT_TRUE(std::isinf(metrics.value("exhibit_uptime_seconds")));
    EXPECT_TRUE(std::isnan(metrics.value("exhibit_fluid_steps_per_second")));
}

TEST(Metrics, AndStatusSayTheSame) {
    const ScratchFolder folder;
    ASSERT_TRUE(write_status(folder / "status.json", busy()));
    ASSERT_TRUE(write_metrics(folder / "eddy.prom", busy()));
    const auto status = nlohmann::json::parse(read_all(folder / "status.json"));
    const Parser metrics(read_all(folder / "eddy.prom"));
    EXPECT_EQ(status["exhibit"]["total"]["visits"], metrics.value("exhibit_visits_total"));
    EXPECT_EQ(status["exhibit"]["state"], "in_use");
    for (const auto& [name, count] : status["guards"].items())
        EXPECT_EQ(count, metrics.value("exhibit_guard_total", {{"guard", name}}));
    EXPECT_EQ(folder.listing().size(), 2U) << "nothing half-written stays";
}

TEST(Metrics, AFolderThatIsGoneDoesNotStopTheShow) {
    EXPECT_FALSE(write_metrics("/nonexistent/eddy.prom", Status{}));
}

TEST(Temperature, IsTheHottestThermometers) {
    const ScratchFolder folder;
    EXPECT_EQ(temperature_c(folder.path()), std::nullopt);
    for (const auto& [zone, milli] : {std::pair("thermal_zone0", "41000\n"),
                                      {"thermal_zone1", "61500\n"},
                                      {"cooling_device0", "99000\n"}}) {
        std::filesystem::create_directory(folder / zone);
        folder.write(std::string(zone) + "/temp", milli);
    }
    std::filesystem::create_directory(folder / "thermal_zone2");  // does not answer
    EXPECT_EQ(temperature_c(folder.path()), 61.5);
    EXPECT_EQ(temperature_c("/nonexistent"), std::nullopt);
}

TEST(FrameTimes, ANightIsNoFrame) {
    using namespace std::chrono_literals;
    FrameTimes frames;
    for (int n = 0; n <= 10; ++n) frames.shown(n * 20ms);
    frames.interrupted();
    for (int n = 0; n <= 10; ++n) frames.shown(10h + n * 20ms);
    EXPECT_EQ(frames.up_to(FrameTimes::kBounds_s.size()), 20U);
    EXPECT_NEAR(frames.sum_s(), 0.4, 1e-9);
}

}  // namespace
}  // namespace eddy
