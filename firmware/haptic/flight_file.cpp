#include "firmware/haptic/flight_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cstring>
#include <iterator>
#include <limits>

#include "firmware/input_error.h"

namespace eddy {
namespace {

constexpr std::string_view kFirstLine = "eddy flight 3";
/// An hour; those that are written have six seconds.
constexpr std::size_t kMostTicks = 3'600'000;
constexpr std::string_view kColumns =
    "# orders: enabled gain most [N], tank under the device's origin x y z, scale, lowest x y z, highest x y "
    "z [m], "
    "resets stop restarts\n"
    "# fluid: force x y z [N], torque x y z [N m], number, for the pose of [ns], period [s], velocity x y z "
    "[m/s],\n"
    "#   acceleration x y z [m/s2], received stored [J]\n"
    "# tick: time, since the last [ns], device's state, whether it obeys, silence [s], whether it answered, "
    "handle x y z [m], "
    "buttons, at [ns];\n"
    "#   then raw, filtered, sent force x y z [N], reason, body x y z [m], velocity x y z [m/s], whether "
    "known\n";

/// Both ways by one list of members: writes them, or reads them.
class Writer {
  public:
    explicit Writer(std::string& text) : text_(text) {}
    void operator()(const double& x) { add(x); }
    void operator()(const bool& x) { add(x ? 1 : 0); }
    void operator()(const std::uint64_t& x) { add(x); }
    void operator()(const std::uint8_t& x) { add(static_cast<unsigned>(x)); }
    void operator()(const Instant& x) { add(x.count()); }
    void operator()(const Seconds& x) { add(x.count()); }
    void operator()(const glm::dvec3& x) { add(x.x), add(x.y), add(x.z); }
    void operator()(const GateReason& x) { add(to_word(x)); }
    void operator()(const HapticState& x) { add(static_cast<int>(x)); }
    void operator()(const ForceLaw& x) { add(x == ForceLaw::Model ? "model" : "filter"); }

  private:
    template <class T>
    void add(const T& x) {
        fmt::format_to(std::back_inserter(text_), " {}", x);
    }
    std::string& text_;
};

/// The words of a line, one after the other.
class Words {
  public:
    Words(std::string_view line, std::string place) : rest_(line), place_(std::move(place)) {}

    [[noreturn]] void refuse(const std::string& what) const {
        throw InputError(fmt::format("{}: {}", place_, what));
    }
    std::string_view word() {
        while (rest_.starts_with(' ')) rest_.remove_prefix(1);
        const std::string_view word = rest_.substr(0, rest_.find(' '));
        if (word.empty()) refuse("the line ends too early");
        rest_.remove_prefix(word.size());
        return word;
    }
    void end() const {
        if (rest_.find_first_not_of(' ') != std::string_view::npos)
            refuse(fmt::format("nothing more is expected here:{}", shown(rest_)));
    }

    template <class T>
    void number(T& x) {
        const std::string_view text = word();
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
        if (error != std::errc{} || end != text.data() + text.size())
            refuse(fmt::format("'{}' is not a number that fits here", shown(text)));
    }
    void operator()(double& x) { number(x); }
    void operator()(std::uint64_t& x) { number(x); }
    void operator()(std::uint8_t& x) { number(x); }
    void operator()(bool& x) {
        std::uint8_t n = 0;
        number(n);
        if (n > 1) refuse(fmt::format("'{}' is neither 0 nor 1", n));
        x = n == 1;
    }
    void operator()(Instant& x) {
        std::int64_t ns = 0;
        number(ns);
        // Three centuries; times are added and subtracted.
        if (ns < 0 || ns > std::numeric_limits<std::int64_t>::max() / 4)
            refuse(fmt::format("'{}' ns is no time of a run", ns));
        x = Instant(ns);
    }
    void operator()(Seconds& x) {
        double s = 0.0;
        number(s);
        x = Seconds(s);
    }
    void operator()(glm::dvec3& x) {
        number(x.x);
        number(x.y);
        number(x.z);
    }
    void operator()(GateReason& x) {
        const std::string_view text = word();
        for (const GateSentence& known : kGateSentences)
            if (known.word == text) {
                x = known.reason;
                return;
            }
        refuse(fmt::format("'{}' is no reason of the gate", shown(text)));
    }
    void operator()(HapticState& x) {
        std::uint8_t n = 0;
        number(n);
        if (n > static_cast<std::uint8_t>(HapticState::Fault))
            refuse(fmt::format("'{}' is no state of a device", n));
        x = static_cast<HapticState>(n);
    }
    void operator()(ForceLaw& x) {
        const std::string_view text = word();
        if (text != "model" && text != "filter")
            refuse(fmt::format("'{}' is neither model nor filter", shown(text)));
        x = text == "model" ? ForceLaw::Model : ForceLaw::Filter;
    }
    /// A piece of a file that may be no text at all.
    static std::string shown(std::string_view text) {
        std::string piece(text.substr(0, 40));
        for (char& c : piece)
            if (c < ' ' || c > '~') c = '?';
        return piece;
    }

  private:
    std::string_view rest_;
    std::string place_;
};

template <class F, class S>
void each(F&& f, S& s) requires std::is_same_v<std::remove_const_t<S>, HapticLoopSettings> {
    f(s.law), f(s.gate.max_force_n), f(s.gate.slew_n_per_s);
    f(s.filter.fraction_of_fluid_rate), f(s.filter.lowest_cutoff_hz), f(s.filter.highest_cutoff_hz);
    f(s.filter.impulse_n);
}

template <class F, class S>
void each(F&& f, S& o) requires std::is_same_v<std::remove_const_t<S>, HapticOrders> {
    f(o.enabled), f(o.gain), f(o.most_n), f(o.tank_from_device.centre_m), f(o.tank_from_device.scale);
    f(o.lowest_m), f(o.highest_m), f(o.resets), f(o.stop), f(o.restarts);
}

template <class F, class S>
void each(F&& f, S& s) requires std::is_same_v<std::remove_const_t<S>, FluidSnapshot> {
    f(s.force_n), f(s.torque_nm), f(s.sequence), f(s.computed_for), f(s.fluid_period), f(s.velocity_m_s);
    f(s.acceleration_m_s2), f(s.received_j), f(s.stored_j);
}

/// All but the fluid and the orders, which have lines of their own, and what follows from the rest.
template <class F, class S>
void each(F&& f, S& t) requires std::is_same_v<std::remove_const_t<S>, FlightTick> {
    f(t.in.now), f(t.step), f(t.in.device), f(t.in.obeys), f(t.in.silence);
    bool answered = t.in.reading.has_value();
    HandleReading reading = t.in.reading.value_or(HandleReading{});
    f(answered), f(reading.position_m), f(reading.buttons), f(reading.taken_at);
    if constexpr (!std::is_const_v<S>) {
        if (answered) t.in.reading = reading;
    }
    f(t.out.raw_n), f(t.out.filtered_n), f(t.out.force_n), f(t.out.reason);
    f(t.out.pose.position_m), f(t.out.pose.velocity_m_s), f(t.out.pose.known);
}

// Whoever adds a member writes it above, or it would be lost.
static_assert(sizeof(HapticOrders) == 128 && sizeof(FluidSnapshot) == 136);

template <class T>
std::string line_of(std::string_view head, const T& what) {
    std::string line(head);
    Writer writer(line);
    each(writer, what);
    return line += '\n';
}

std::string hex_of(const HandState& state) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(&state);
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text;
    text.reserve(2 * sizeof(HandState));
    for (std::size_t i = 0; i < sizeof(HandState); ++i) {
        text += kDigits[bytes[i] >> 4];
        text += kDigits[bytes[i] & 15];
    }
    return text;
}

void read_state(Words& words, const std::string& version, HandState& state) {
    // What the law has in mind means something to that very law alone.
    if (version != EDDY_VERSION)
        words.refuse(fmt::format("was flown by eddy {}, and this is eddy " EDDY_VERSION
                                 ", whose law may be another: rerun it with the one that wrote it",
                                 version));
    std::uint64_t size = 0;
    words(size);
    const std::string_view hex = words.word();
    if (size != sizeof(HandState) || hex.size() != 2 * sizeof(HandState))
        words.refuse(fmt::format(
            "the law that flew this kept {} bytes in mind, this one {}: rerun it with the version that "
            "wrote it, eddy {}",
            size, sizeof(HandState), version));
    std::vector<unsigned char> bytes(sizeof(HandState));
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const char* pair = hex.data() + 2 * i;
        const auto [end, error] = std::from_chars(pair, pair + 2, bytes[i], 16);
        if (error != std::errc{} || end != pair + 2) words.refuse("the state is not in hexadecimal digits");
    }
    std::memcpy(&state, bytes.data(), sizeof(HandState));
    if (!is_sound(state)) words.refuse("no law was ever in this state");
}

}  // namespace

// Fowler, Noll and Vo's hash, 1a, 64 bits: finds what a cable or a disk did to a file.
std::uint64_t flight_sum(std::string_view lines) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : lines) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return hash;
}

std::string flight_text(const Flight& flight) {
    std::string text =
        fmt::format("{}\n{}version {}\nwritten {}\n", kFirstLine, kColumns, flight.version, flight.written);
    text += fmt::format("cause {} {}\n", to_word(flight.cause), flight.at.count());
    text += line_of("settings", flight.settings);
    text += fmt::format("state {} {}\n", sizeof(HandState), hex_of(flight.start));
    std::string orders, fluid;
    for (const FlightTick& tick : flight.ticks) {
        if (std::string now = line_of("orders", tick.in.orders); now != orders)
            text += orders = std::move(now);
        if (std::string now = line_of("fluid", tick.in.fluid); now != fluid) text += fluid = std::move(now);
        text += line_of("tick", tick);
    }
    return text + fmt::format("end {} {:016x}\n", flight.ticks.size(), flight_sum(text));
}

Flight read_flight(std::string_view text, const std::string& name) {
    if (!text.starts_with(kFirstLine) || text.substr(kFirstLine.size(), 1) != "\n")
        throw InputError(
            fmt::format("{}: is not a flight recording: it does not begin with '{}'", name, kFirstLine));
    const std::size_t end = text.rfind("\nend ") + 1;
    if (end == 0 || text.find('\n', end) != text.size() - 1)
        throw InputError(fmt::format("{}: is not complete: its last line does not begin with 'end'", name));
    std::uint64_t ticks = 0;
    {
        Words words(text.substr(end, text.size() - end - 1), name);
        words.word();
        words(ticks);
        const std::string_view hash = words.word();
        words.end();
        if (hash != fmt::format("{:016x}", flight_sum(text.substr(0, end))))
            throw InputError(fmt::format(
                "{}: was changed since it was written, or damaged: its last line says another sum", name));
    }
    Flight flight;
    bool state = false, settings = false, caused = false;
    HapticOrders orders;
    FluidSnapshot fluid;
    std::size_t at = 0;
    for (int number = 1; at < end; ++number) {
        const std::size_t stop = text.find('\n', at);
        const std::string_view line = text.substr(at, stop - at);
        at = stop + 1;
        if (number == 1 || line.starts_with('#')) continue;
        Words words(line, fmt::format("{}:{}", name, number));
        const std::string_view head = words.word();
        if (head == "version") {
            flight.version = Words::shown(words.word());
        } else if (head == "written") {
            flight.written = Words::shown(words.word());
        } else if (head == "cause") {
            words(flight.cause), words(flight.at);
            caused = true;
        } else if (head == "settings") {
            each(words, flight.settings);
            settings = true;
        } else if (head == "state") {
            read_state(words, flight.version, flight.start);
            state = true;
        } else if (head == "orders") {
            each(words, orders);
        } else if (head == "fluid") {
            each(words, fluid);
        } else if (head == "tick") {
            if (flight.ticks.size() == kMostTicks) words.refuse("no flight is longer than an hour");
            FlightTick tick;
            each(words, tick);
            tick.in.orders = orders;
            tick.in.fluid = fluid;
            flight.ticks.push_back(tick);
        } else {
            words.refuse(fmt::format("'{}' is no kind of line", Words::shown(head)));
        }
        words.end();
    }
    if (!state || !settings || !caused || flight.ticks.empty() || flight.ticks.size() != ticks)
        throw InputError(fmt::format(
            "{}: lacks lines: there must be a cause, the settings, the state and {} ticks", name, ticks));
    return flight;
}

}  // namespace eddy
