#pragma once
#include "firmware/verbs/verbs.h"

namespace eddy {

/// Both loops on one virtual clock and one thread: the same input gives the same run, bit for bit. The fluid's answer reaches
/// the hand one fluid period after its question, as on a GPU that works on it meanwhile. No screen, no panel, nobody to attend to.
int run_stepped(const RunOptions& options);

}  // namespace eddy
