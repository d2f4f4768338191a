#pragma once
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace eddy {

/// Where a value was written. Lines and columns count from 1; line 0 means the file as a whole.
/// For a command-line override, file is "--set", line its number among the overrides, column that of its
/// text.
struct Place {
    std::string file;
    int line = 0;
    int column = 0;
};

/// "file:line:column", or "file" alone.
std::string to_string(const Place& place);

/// Key path ("body.0.radius_m", as --set takes it) to the place that set it. A key that is absent kept its
/// default. Tables are listed too; "" is the whole document.
using Origins = std::map<std::string, Place>;

/// The place of `key`, or that of the innermost table around it that was written down.
Place place_of(const Origins& origins, std::string key);

/// One thing wrong with a configuration: where, which key, and in the message what is wrong and what to write
/// instead.
struct Diagnostic {
    std::string file;
    int line = 0;
    int column = 0;
    std::string key;  ///< key path; empty for a syntax error or an unreadable file
    std::string message;
};

Diagnostic diagnose(const Place& place, std::string key, std::string message);

/// "file:line:column: key: message", on one line whatever the parts hold.
std::string to_string(const Diagnostic& diagnostic);

inline constexpr std::size_t kMostDiagnostics = 100;

/// Thrown by every loader, with all that is wrong and not only the first. what() has one line for each
/// diagnostic, in the order of file, line and column; of more than a hundred, the first hundred and how many more there are.
class ConfigError : public std::runtime_error {
  public:
    explicit ConfigError(std::vector<Diagnostic> diagnostics);
    const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

  private:
    std::vector<Diagnostic> diagnostics_;
};

/// `text` as a TOML basic string: in double quotes, with quotes, backslashes and control characters escaped.
std::string in_quotes(std::string_view text);

}  // namespace eddy
