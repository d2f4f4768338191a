#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/scene.h"
#include "firmware/stability/fault.h"
#include "firmware/stability/history.h"

namespace eddy::stability {

/// How hard the solver tries.
enum class Effort {
    Default,  ///< as the exhibit at its best: the preset precise
    Least     ///< the preset fast with one cycle
};
std::string_view to_word(Effort effort);

/// Where a case is tried.
struct Trial {
    glm::ivec3 cells{8};
    Effort effort = Effort::Default;
    bool operator==(const Trial&) const = default;
};
/// "33x47x29", "25^3".
std::string grid_name(const glm::ivec3& cells);
/// The other way; 25 is 25^3. Throws InputError.
glm::ivec3 grid_named(const std::string& name);

/// A step that is about to be taken. The script of a case sees the first part and changes the second.
struct Moment {
    long step = 0;             ///< from 0
    double time_s = 0.0;       ///< at its beginning
    double calm_from_s = 0.0;  ///< when what disturbs has to end
    const Scene* scene = nullptr;
    /// Times are sums of steps: what they lack in rounding is not a step.
    bool disturbs() const { return time_s + 1e-9 < calm_from_s; }
    glm::dvec3 middle_m() const { return 0.5 * scene->tank.size_m; }
    double cell_m() const { return scene->tank.cell_m(); }

    double dt_s = 0.02;
    glm::dvec3 hand_m{0.0};       ///< where the handle shows the body, Tank frame
    std::vector<Fault> faults{};  ///< written into textures before the step
    bool reset = false;           ///< back to the start before the step
    bool holds_answer = false;    ///< what the step finds does not reach the hand
    bool change_preset = false;   ///< to the other of fast and precise, before the step; only with a hand
    bool look = false;            ///< download the fields after it, whatever else
    /// What the velocity field becomes before the step; only without a hand.
    std::function<void(std::vector<glm::vec3>&)> flow{};
};

/// Who moves the fluid on.
enum class Drive {
    Any,    ///< steps, unless another case at the same time wants a hand
    Steps,  ///< Fluid::step, with bodies given as the case likes
    Hand    ///< the exhibit: Show, and the 1 kHz law with its gate
};

/// One row of the matrix: what makes it hard, as changes to the common scene, so that two can be had at once.
struct Case {
    int number = 0;             ///< that of the list of hard cases; several may share one
    std::string name = {};      ///< "teleport-5"
    std::string title = {};     ///< what happens
    std::string provokes = {};  ///< what it makes fail in a solver that is not ready for it
    std::string wants = {};     ///< in words: what must hold besides the rule; empty: nothing
    std::string when_red = {};  ///< what is known of it being red: why, and what keeps the exhibit safe
    Drive drive = Drive::Any;
    std::function<void(Scene&)> change = {};
    std::function<void(Moment&)> script = {};
    /// Changes where bodies are said to be, before the fluid is told; only without a hand.
    std::function<void(const Moment&, std::vector<gles::BodyState>&)> bodies = {};
    /// Changes what the fluid is made of where no scene can; only without a hand.
    std::function<void(gles::FluidSetup&)> solids = {};
    /// A figure of the case's own, taken at each look: History::Look::measured.
    std::function<double(gles::Gpu&, const gles::Fluid&, const Fields&, double time_s)> measure = {};
    /// What is wrong, if `wants` does not hold.
    std::function<std::optional<std::string>(const History&)> complaint = {};
    /// A figure that the reader wants to know, green or red, in words.
    std::function<std::string(const History&)> remark = {};
    bool compares = false;       ///< with the common scene, which is run as well
    bool ends_when_red = false;  ///< how far it goes after that is of no interest
    bool looks_always = false;   ///< into the fields, after each step, whatever that costs
    long steps = 500;
    /// In fewer, what makes it hard does not all happen, or not all of it can be judged.
    long least_steps = 0;
    double calm_share =
        0.5;  ///< of the steps, at the end, in which nothing disturbs; 0: something always does
    /// After those steps all that disturbs is stopped, for so long: what it `wants` is judged before. With calm_share 0; alone only.
    double calm_s = 0.0;
    /// How much faster the flow must be in a gap: see Justified. None: no gap is narrow.
    std::function<double(const glm::ivec3& cells)> narrowing = {};
    bool puts_faults = false;  ///< its script does
    /// Transport must not make new extremes of the velocity; alone only, with cut cells.
    bool watches_transport = false;
    bool may_be_idle = false;            ///< what moves may be where there is no fluid
    long pardon_steps = 0;               ///< after a fault: how many steps it may take to heal
    bool small_only = false;             ///< takes too long on large grids
    bool full_only = false;              ///< takes too long for a quick look
    bool alone = false;                  ///< asks for what another case may rule out: not for pairs
    std::vector<glm::ivec3> grids = {};  ///< in place of the matrix's
};

/// Every case, by number.
const std::vector<Case>& all_cases();

/// What the list of hard cases asks for and no cell of the matrix tries.
struct NotTried {
    int number;
    std::string what, why;
};
/// What this version does not have.
const std::vector<NotTried>& not_offered();
/// What is tried in another way.
const std::vector<NotTried>& tried_elsewhere();

/// The cases that a user means by "23" or "teleport-5". Throws InputError that lists the names.
std::vector<const Case*> cases_named(const std::string& name);

/// The scene that all cases change: inviscid air with a ball of smoke, and a ball in the hand, 0.16 m long.
Scene common_scene(const Trial& trial);

/// In steps that begin then or later no source and no wall drives the fluid.
void falls_silent(Scene& scene, double stop_s);
/// The time that moves the scene's own bodies: it runs down to a halt within kRunDownS of stop_s.
double running_down_s(double time_s, double stop_s);
inline constexpr double kRunDownS = 0.2;

/// Where the hand is when no case says otherwise: it stirs, then rests in the middle.
glm::dvec3 stroke_m(const Moment& moment);

// The rows, by what makes them hard.
std::vector<Case> jet_cases();       // 1, 19, 20
std::vector<Case> time_cases();      // 2, 3
std::vector<Case> hand_cases();      // 4, 5, 30, 34
std::vector<Case> wall_cases();      // 6, 7, 10, 11
std::vector<Case> body_cases();      // 8, 9, 12, 13
std::vector<Case> distance_cases();  // 33
std::vector<Case> friction_cases();  // 14, 15, 16, 29
std::vector<Case> effect_cases();    // 17, 18
std::vector<Case> number_cases();    // 22, 26, 27, 28
std::vector<Case> fault_cases();     // 23, 24, 25

}  // namespace eddy::stability
