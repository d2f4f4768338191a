#pragma once

namespace eddy::kms {

/// The text console that the kernel draws on the screen. A process that owns one (its controlling terminal is a virtual one:
/// TTYPath= in a unit) keeps its text and cursor off the picture and gives them back; any other has none, and this does nothing.
class Console {
  public:
    /// `path`: of the controlling terminal.
    explicit Console(const char* path = "/dev/tty");
    ~Console();
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    bool owned() const { return fd_ >= 0; }
    void set_text(bool on);

  private:
    int fd_ = -1;
    int found_mode_ = 0;
    bool changed_ = false;
};

}  // namespace eddy::kms
