#include "firmware/accuracy/sweep/pareto.h"

#include <algorithm>
#include <cmath>

namespace eddy::accuracy::sweep {

Chosen chosen(std::span<const Measurement> all, const std::function<bool(const Measurement&)>& wanted) {
    Chosen some;
    for (const Measurement& m : all)
        if (wanted(m)) some.push_back(&m);
    return some;
}

Chosen front(const Chosen& some) {
    Chosen sorted = some;
    std::stable_sort(sorted.begin(), sorted.end(), [](const Measurement* a, const Measurement* b) {
        return a->wall_ms.p50 != b->wall_ms.p50 ? a->wall_ms.p50 < b->wall_ms.p50 : a->error < b->error;
    });
    Chosen best;
    for (const Measurement* m : sorted)
        if (!std::isnan(m->error) && (best.empty() || m->error < best.back()->error)) best.push_back(m);
    return best;
}

const Measurement* quickest_within(const Chosen& some, double error) {
    for (const Measurement* m : front(some))
        if (m->error <= error) return m;
    return nullptr;
}

const Measurement* best_within(const Chosen& some, double wall_ms) {
    const Measurement* best = nullptr;
    for (const Measurement* m : front(some))
        if (m->wall_ms.p50 <= wall_ms) best = m;
    return best;
}

const Measurement* enough(const Chosen& by_iterations) {
    if (by_iterations.size() < 2) return nullptr;
    for (std::size_t i = 0; i < by_iterations.size(); ++i) {
        const auto all_gain_little = [&](double error) {
            return std::all_of(by_iterations.begin() + static_cast<std::ptrdiff_t>(i), by_iterations.end(),
                               [&](const Measurement* later) { return later->error > 0.9 * error; });
        };
        if (all_gain_little(by_iterations[i]->error)) return by_iterations[i];
    }
    return by_iterations.back();
}

}  // namespace eddy::accuracy::sweep
