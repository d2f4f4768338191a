#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "firmware/accuracy/laboratory.h"

namespace eddy::accuracy {

/// How the time step follows the width h of a cell when the grid of a scene is changed.
enum class TimeStep {
    Same,      ///< dt stays
    Courant,   ///< dt ~ h: the fluid crosses as much of a cell
    Diffusion  ///< dt ~ h^2: halving h quarters the errors of a first-order step too
};

/// The most that an error may be on grids of so many cells along the longest side, and finer.
struct Limit {
    int cells;
    double error;
};

/// What a case measures, and what it should be.
struct Quantity {
    enum class Error {
        Relative,  ///< |measured - exact| / |exact|
        Absolute,  ///< |measured - exact|
        Shortfall  ///< exact - measured; 0 where it is more
    };
    std::string name = {};
    double exact = 0.0;
    std::string source = {};  ///< of the exact value
    Error error = Error::Absolute;
    std::vector<Limit> limits = {};          ///< coarsest first; none: shown, not judged
    std::optional<double> least_order = {};  ///< of convergence between the two finest grids
    bool estimates_error =
        false;  ///< of the quantity before it; not judged: counted is how often it covers it
};

/// One page of the textbook: a scene, how it is refined, and what comes out of it.
struct Case {
    std::string name = {};              ///< "B2-shell"; what is before a dash or a point is its family
    std::string title = {};             ///< one line
    std::string scene = {};             ///< a shipped one: "validation/B2"
    std::vector<std::string> set = {};  ///< what is changed in it, as --set takes it
    TimeStep time_step = TimeStep::Same;
    int parts = 1;  ///< of the scene's time, all alike, each of which is a whole number of steps
    std::vector<int> quick = {};  ///< cells along the longest side; none: the case is only run in full
    std::vector<int> full = {};
    std::vector<Quantity> quantities = {};
    /// The quantities, in their order, on the laboratory's grid.
    std::function<std::vector<double>(Laboratory&)> measure = {};
};

/// Every case, by name.
const std::vector<Case>& all_cases();

/// The cases that a user means by "B2-shell", by "B2" or by "B8" (whole families). Throws InputError that lists the names.
std::vector<const Case*> cases_named(const std::string& name);

// The pages, one file for each family.
std::vector<Case> taylor_green_cases();   // A1, A2
std::vector<Case> exact_flow_cases();     // A3, A4
std::vector<Case> rest_cases();           // A7
std::vector<Case> internal_wave_cases();  // A8
std::vector<Case> cavity_cases();         // A11
std::vector<Case> viscous_flow_cases();   // A12
std::vector<Case> deformation_cases();    // A15
std::vector<Case> smoke_mass_cases();     // A16
std::vector<Case> inflow_cases();         // A17
std::vector<Case> confinement_cases();    // A18
std::vector<Case> archimedes_cases();     // B1
std::vector<Case> added_mass_cases();     // B2
std::vector<Case> creeping_flow_cases();  // B3, B4
std::vector<Case> swinging_ball_cases();  // B5
std::vector<Case> sphere_drag_cases();    // B6
std::vector<Case> disk_and_cube_cases();  // B7
std::vector<Case> balance_cases();        // B8.1, B8.2, B8.3
std::vector<Case> invariance_cases();     // B8.4, B8.5, B8.8, B8.9, B8.11, B8.12
std::vector<Case> reciprocity_cases();    // B8.13
std::vector<Case> ripple_cases();         // B8.7
std::vector<Case> free_ball_cases();      // B10
std::vector<Case> three_ways_cases();     // F1

}  // namespace eddy::accuracy
