#include "firmware/exhibit/panel.h"

#include <poll.h>

#include <thread>

#include "firmware/exhibit/panel_work.h"

namespace eddy {

class Panel::Thread {
  public:
    Thread(Gpio& gpio, const GpioConfig& config, Instant patience) : work(gpio, config) {
        work.work(clock_.now());
        while (!work.stop_is_known() && clock_.now() < patience) {
            clock_.sleep_until(clock_.now() + kPeriod);
            work.work(clock_.now());
        }
        thread_ = std::thread([this] { run(); });
    }
    ~Thread() {
        end_.store(true, std::memory_order_relaxed);
        thread_.join();
        work.darken(clock_.now());
    }
    Thread(const Thread&) = delete;
    Thread& operator=(const Thread&) = delete;

    PanelWork work;

  private:
    void run() {
        while (!end_.load(std::memory_order_relaxed)) {
            wait();
            work.work(clock_.now());
        }
    }
    /// For the next edge, or kPeriod.
    void wait() {
        pollfd files[2];
        nfds_t count = 0;
        for (const int fd : work.edges_fds())
            if (fd >= 0) files[count++] = {fd, POLLIN, 0};
        constexpr auto kPeriodMs = std::chrono::duration_cast<std::chrono::milliseconds>(kPeriod).count();
        poll(files, count, static_cast<int>(kPeriodMs));
    }

    RealClock clock_;
    std::atomic<bool> end_{false};
    std::thread thread_;
};

Panel::Panel(Gpio& gpio, const GpioConfig& config, Instant patience)
    : thread_(std::make_unique<Thread>(gpio, config, patience)) {}
Panel::~Panel() = default;

void Panel::show(LampCode code) {
    thread_->work.show(code);
}
PanelNews Panel::news() {
    return thread_->work.news();
}
const std::atomic<bool>& Panel::stop_input() const {
    return thread_->work.stop_input();
}
HandleLight Panel::handle_light() const {
    return thread_->work.handle_light();
}
std::uint64_t Panel::beats() const {
    return thread_->work.beats();
}

}  // namespace eddy
