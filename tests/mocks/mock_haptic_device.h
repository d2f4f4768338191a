#pragma once
#include <gmock/gmock.h>

#include "hal/haptic/haptic_device.h"

namespace eddy {

/// Expectations only. For a device that behaves, use the emulator.
class MockHapticDevice : public HapticDevice {
  public:
    MOCK_METHOD(void, poll, (Instant now), (override));
    MOCK_METHOD(std::optional<HandleReading>, read, (), (override));
    MOCK_METHOD(void, command, (const glm::dvec3& force_n), (override));
    MOCK_METHOD(void, show, (const HandleLight& light), (override));
    MOCK_METHOD(HapticState, state, (), (const, override));
    MOCK_METHOD(HapticCounters, counters, (), (const, override));
    MOCK_METHOD(Seconds, silence, (Instant now), (const, override));
    MOCK_METHOD(std::string, describe, (), (const, override));
};

}  // namespace eddy
