#include "firmware/exhibit/panel.h"

#include <poll.h>
#include <pthread.h>

#include <thread>

#include "firmware/exhibit/panel_work.h"

namespace eddy {

class Panel::Thread {
  public:
    Thread(Gpio& gpio, const GpioConfig& config, Instant patience) : work(gpio, config), patience_(patience) {
        look();
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
    std::atomic<bool> settled{false};

  private:
    void run() {
        pthread_setname_np(pthread_self(), "eddy:panel");
        while (!end_.load(std::memory_order_relaxed)) {
            wait();
            look();
        }
    }
    void look() {
        const Instant now = clock_.now();
        work.work(now);
        if (work.stop_is_known() || now >= patience_) settled.store(true, std::memory_order_release);
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
    const Instant patience_;
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
bool Panel::settled() const {
    return thread_->settled.load(std::memory_order_acquire);
}
HandleLight Panel::handle_light() const {
    return thread_->work.handle_light();
}
std::uint64_t Panel::beats() const {
    return thread_->work.beats();
}

}  // namespace eddy
