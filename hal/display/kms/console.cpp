#include "hal/display/kms/console.h"

#include <fcntl.h>
#include <linux/kd.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace eddy::kms {

Console::Console(const char* path) {
    fd_ = open(path, O_RDWR | O_NOCTTY | O_CLOEXEC);
    // Only a virtual terminal has such a mode; a serial line or a remote session has not.
    if (fd_ >= 0 && ioctl(fd_, KDGETMODE, &found_mode_) != 0) {
        close(fd_);
        fd_ = -1;
    }
}

Console::~Console() {
    set_text(true);
    if (fd_ >= 0) close(fd_);
}

void Console::set_text(bool on) {
    if (fd_ < 0 || on == !changed_) return;
    if (ioctl(fd_, KDSETMODE, static_cast<long>(on ? found_mode_ : KD_GRAPHICS)) == 0) changed_ = !on;
}

}  // namespace eddy::kms
