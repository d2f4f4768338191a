#include "firmware/exhibit/clock_sync.h"

#include <sys/timex.h>

namespace eddy {

KernelClock ask_kernel() {
    timex question{};
    const int answer = ::adjtimex(&question);
    if (answer < 0) return KernelClock::NotTold;
    const bool unset = answer == TIME_ERROR || (question.status & STA_UNSYNC) != 0;
    return unset ? KernelClock::Unsynchronised : KernelClock::Synchronised;
}

bool ClockSync::look(KernelClock kernel) {
    std::error_code error;
    if (!synchronised_)
        synchronised_ = kernel == KernelClock::Synchronised || std::filesystem::exists(file_, error);
    return synchronised_;
}

}  // namespace eddy
