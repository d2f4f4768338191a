#include "firmware/command_line.h"

#include <charconv>

namespace eddy {

CLI::Validator number_from(double low, double high) {
    return CLI::Validator(
        [low, high](std::string& text) {
            double number = 0.0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
            if (error == std::errc{} && end == text.data() + text.size() && number >= low && number <= high)
                return std::string();
            return fmt::format("'{}' is not a number from {} to {}", text, low, high);
        },
        "");
}

void add_set(CLI::App& verb, std::vector<std::string>& set) {
    verb.add_option("--set", set, "change a key of the scene: --set solver.dt_s=0.01; may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false)
        ->take_all();
}

void add_config(CLI::App& verb, std::string& folder, const std::string& help) {
    verb.add_option("--config", folder, help)->type_name("DIR")->capture_default_str();
}

}  // namespace eddy
