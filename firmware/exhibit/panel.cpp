#include "firmware/exhibit/panel.h"

#include <poll.h>
#include <pthread.h>

#include <thread>

#include "firmware/exhibit/panel_work.h"

namespace eddy {

class Panel::Thread {
  public:
    Thread(Gpio& gpio, const GpioConfig& config, const Clock& clock, const std::filesystem::path& stop_file,
           Instant patience)
        : work(gpio, config, stop_file), clock_(clock), patience_ends_(clock.now() + patience) {
        thread_ = std::thread([this] { run(); });
    }
    ~Thread() {
        end_.store(true, std::memory_order_relaxed);
        thread_.join();
        work.darken(clock_.now());
    }
    Thread(const Thread&) = delete;
    Thread& operator=(const Thread&) = delete;

    bool settled() const { return work.stop_is_known() || clock_.now() >= patience_ends_; }

    PanelWork work;

  private:
    void run() {
        pthread_setname_np(pthread_self(), "eddy:panel");
        while (!end_.load(std::memory_order_relaxed)) {
            work.work(clock_.now());
            wait();
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

    const Clock& clock_;
    const Instant patience_ends_;
    std::atomic<bool> end_{false};
    std::thread thread_;
};

Panel::Panel(Gpio& gpio, const GpioConfig& config, const Clock& clock, const std::filesystem::path& stop_file,
             Instant patience)
    : thread_(std::make_unique<Thread>(gpio, config, clock, stop_file, patience)) {}
Panel::~Panel() = default;

void Panel::show(LampCode code) {
    thread_->work.show(code);
}
PanelNews Panel::news() {
    return thread_->work.news();
}
const StopInput& Panel::stop_input() const {
    return thread_->work.stop_input();
}
bool Panel::settled() const {
    return thread_->settled();
}
bool Panel::stop_was_held() const {
    return thread_->work.stop_was_held();
}
HandleLight Panel::handle_light() const {
    return thread_->work.handle_light();
}
std::uint64_t Panel::beats() const {
    return thread_->work.beats();
}

}  // namespace eddy
