#pragma once
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "hal/haptic/emulated/usb_device.h"

struct usbdevfs_urb;

namespace eddy::usb {

/// While one lives, its thread is in the emulated kernel and not in the program.
class InKernel {
  public:
    InKernel() { ++depth_; }
    ~InKernel() { --depth_; }
    InKernel(const InKernel&) = delete;
    InKernel& operator=(const InKernel&) = delete;
    static bool now() { return depth_ > 0; }

  private:
    static thread_local int depth_;
};

/// A device on the bus, and what the kernel knows of it.
struct Port {
    Port(std::string name, std::unique_ptr<emulated::EmulatedFalcon> falcon, emulated::UsbIdentity identity)
        : sysname(std::move(name)), device(std::move(falcon), std::move(identity)) {}

    std::string sysname;  ///< as below /sys/bus/usb/devices
    int address = 0;      ///< a new one each time it is plugged in
    bool plugged_in = false;
    emulated::UsbDevice device;

    bool denied = false;              ///< the device file may not be opened
    bool claimed_by_another = false;  ///< another program has claimed the interface
    bool bound_to_driver = false;     ///< a driver of the kernel has the interface
    int opened = 0;                   ///< times the device file was opened
    int claimed = 0;                  ///< times the interface was claimed
};

/// The part of a kernel that libusb sees: one bus, its device files (/dev/bus/usb), what sysfs says of them, and the
/// messages of udev. A program that links usbfs.cpp, or is started with it preloaded, reaches this bus through the
/// functions of its own C library, and no other bus. Needs no rights and no module; any thread.
class Bus {
  public:
    /// Each program has one.
    static Bus& instance();

    Port& plug(std::unique_ptr<emulated::EmulatedFalcon> falcon, emulated::UsbIdentity identity = {});
    void unplug(Port& port);
    void replug(Port& port, bool kept_power);
    /// Takes everything off the bus.
    void clear();

    /// Virtual time goes on to `now`. A program that waits for a device file in poll() moves it on, too.
    void advance(Instant now);
    /// From now on time is the machine's.
    void use_real_time();
    Instant now() const;
    std::recursive_mutex& mutex() { return mutex_; }

    // --- for usbfs.cpp ---------------------------------------------------------------------------------------

    /// A message of udev.
    struct Event {
        std::string action, sysname, device_file;
    };
    std::optional<Event> next_event();
    int event_fd();
    std::vector<std::string> sysnames() const;
    /// What a file of sysfs holds; nothing if there is no such file.
    std::optional<std::string> sysfs_file(const std::string& sysname, const std::string& attribute) const;

    /// These return what the system call would, with errno set.
    int open_device(int bus, int address);
    bool is_open(int fd) const { return files_.contains(fd); }
    void close_device(int fd);
    int ioctl(int fd, unsigned long request, void* argument);
    /// Moves time on and makes each file ready to poll() that has something to say.
    void refresh();
    bool virtual_time() const { return !real_start_; }

  private:
    struct File {
        Port* port;
        int address;   ///< of the device when it was opened: after an unplugging this file stays dead
        int read_end;  ///< of the pipe whose other end is the file; -1 once the device has gone
        bool quiet;    ///< the pipe is full: poll() says that it cannot be written
        bool claimed = false;
        std::map<const void*, usbdevfs_urb*> urbs{};
        std::deque<usbdevfs_urb*> ended{};
    };
    bool alive(const File& file) const { return file.port->plugged_in && file.port->address == file.address; }
    /// Hands what the devices have ended to the files it was asked for through.
    void collect();
    void set_quiet(File& file, int fd, bool quiet);
    void announce(const char* action, const Port& port);
    int claim(File& file, bool take_from_driver);

    mutable std::recursive_mutex mutex_;
    std::vector<std::unique_ptr<Port>> ports_;
    std::map<int, File> files_;
    std::deque<Event> events_;
    int event_pipe_[2] = {-1, -1};
    int next_address_ = 2;
    Instant now_{0};
    std::optional<Instant> real_start_;
};

}  // namespace eddy::usb
