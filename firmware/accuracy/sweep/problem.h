#pragma once
#include <string>
#include <vector>

#include "firmware/accuracy/case.h"
#include "firmware/accuracy/sweep/setting.h"

namespace eddy::accuracy::sweep {

/// Errors at which a table asks for the time, as a share of the force.
struct Threshold {
    double error;
    std::string name;  ///< "10 %", "7 % (hand)"
};

/// A case with a known answer, boiled down to one error that can be held against time.
struct Problem {
    std::string name = {};
    std::string plain = {};    ///< "a sudden start", for who does not know the case
    std::string title = {};    ///< one line
    std::string picture = {};  ///< name of its plot
    std::string error = {};    ///< what its error is an error of, for axes
    Case of = {};              ///< scene, and how its time step follows the grid
    std::vector<int> quick = {}, full = {};
    std::vector<Threshold> thresholds = {};  ///< of the headline table; none: not in it
    double hand = 0.0;                       ///< the greatest error that a hand cannot tell; 0: not known
    /// The worst of what the laboratory's scene, run with this setting, gets wrong.
    std::function<double(Laboratory&, const Setting&)> measure = {};
};

/// B2, B3, B8.7 and A1, in this order.
const std::vector<Problem>& all_problems();

/// Throws InputError that lists the names.
const Problem& problem_named(const std::string& name);

/// Rates of the fluid that an exhibit may want: still usable, the default, that of a good screen.
inline constexpr double kRatesHz[] = {20.0, 50.0, 75.0};

/// Two forces that differ by this share can just be told apart (Jones 1989, Perception 18).
constexpr double kForceJnd = 0.07;
/// The same of two viscosities (Jones, Hunter and Lafontaine 1997, Perception 26); 34 % where a hand adjusts one to match.
constexpr double kViscosityJnd = 0.19;

}  // namespace eddy::accuracy::sweep
