#include "config/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace eddy {
namespace {

bool is_control(char c) {
    return (c >= 0 && c < 0x20) || c == 0x7f;
}

// Control characters become escapes, so that a key or a file name cannot break the line.
std::string one_line(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (is_control(c))
            out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            out += c;
    }
    return out;
}

std::vector<Diagnostic> sorted(std::vector<Diagnostic> diagnostics) {
    std::stable_sort(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::tie(a.file, a.line, a.column) < std::tie(b.file, b.line, b.column);
    });
    if (diagnostics.size() > kMostDiagnostics) {
        const std::size_t more = diagnostics.size() - kMostDiagnostics;
        diagnostics.resize(kMostDiagnostics);
        Diagnostic& last = diagnostics.emplace_back(diagnostics.back());
        last.key.clear();
        last.message = fmt::format("and {} more that are wrong", more);
    }
    return diagnostics;
}

std::string joined(const std::vector<Diagnostic>& diagnostics) {
    std::string out;
    for (const Diagnostic& d : diagnostics) out += fmt::format("{}{}", out.empty() ? "" : "\n", to_string(d));
    return out;
}

}  // namespace

std::string to_string(const Place& place) {
    if (place.line == 0) return place.file;
    return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

Place place_of(const Origins& origins, std::string key) {
    while (true) {
        if (const auto found = origins.find(key); found != origins.end()) return found->second;
        if (key.empty()) return {};
        const std::size_t dot = key.rfind('.');
        key.resize(dot == std::string::npos ? 0 : dot);
    }
}

Diagnostic diagnose(const Place& place, std::string key, std::string message) {
    return {place.file, place.line, place.column, std::move(key), std::move(message)};
}

std::string to_string(const Diagnostic& d) {
    const std::string key = d.key.empty() ? "" : d.key + ": ";
    return one_line(to_string(Place{d.file, d.line, d.column}) + ": " + key + d.message);
}

ConfigError::ConfigError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(joined(sorted(diagnostics))), diagnostics_(sorted(std::move(diagnostics))) {}

std::string in_quotes(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return one_line(out + '"');
}

}  // namespace eddy
