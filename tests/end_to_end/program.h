#pragma once
#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

#include "tests/scratch_folder.h"

namespace eddy {

/// What a program left when it ended.
struct Ended {
    int status = 0;  ///< exit status, or 128 + signal
    std::string out;
    std::string err;  ///< less what only a slow machine has: lines on how far long work has come
};

/// A child process, started without a shell; its output goes to files.
class Program {
  public:
    /// arguments[0] is looked up in PATH unless it holds a slash.
    explicit Program(std::vector<std::string> arguments);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void send(int signal) const;
    /// A program that has not ended by then is killed; however slow the machine, before ctest gives the test up.
    Ended wait(std::chrono::seconds patience = std::chrono::minutes(9));

  private:
    ScratchFolder output_;
    pid_t pid_ = 0;
};

/// Runs the eddy under test to its end.
Ended eddy(std::vector<std::string> arguments);
/// What Program takes to start the eddy under test.
std::vector<std::string> eddy_command(std::vector<std::string> arguments);

/// Whether pictures of plots can be drawn here.
bool has_gnuplot();

/// Makes any scene quick, with --set.
inline const std::string kTiny = "tank.cells=[16,16,16]";

std::vector<std::string> lines_of(const std::string& text);
std::vector<std::string> split(const std::string& text, char separator);

}  // namespace eddy
