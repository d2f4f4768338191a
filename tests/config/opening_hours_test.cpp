#include "config/opening_hours.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace eddy {
namespace {

using namespace std::chrono;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string complaint_of(std::string_view day) {
    try {
        parse_day(day);
    } catch (const std::invalid_argument& e) {
        return e.what();
    }
    return "";
}

std::string complaint_of_exceptions(std::string_view text) {
    try {
        parse_exceptions(text);
    } catch (const std::invalid_argument& e) {
        return e.what();
    }
    return "";
}

TEST(DayHours, AreRangesClosedOrAllDay) {
    EXPECT_THAT(parse_day("09:00-17:30"), ElementsAre(OpenRange{540, 1050}));
    EXPECT_THAT(parse_day(" 13:00 - 17:00,09:00-12:00 "),
                ElementsAre(OpenRange{540, 720}, OpenRange{780, 1020}));
    EXPECT_THAT(parse_day("closed"), IsEmpty());
    EXPECT_THAT(parse_day(" "), ElementsAre(OpenRange{0, 1440}));
    EXPECT_THAT(parse_day("18:00-24:00"), ElementsAre(OpenRange{1080, 1440}));
}

TEST(DayHours, SayWhatIsWrongWithThem) {
    for (const char* text :
         {"9:00-17:00", "09:00-24:01", "09:60-10:00", "aa:00-10:00", "09.00-10:00", "-", "09:00-"})
        EXPECT_THAT(complaint_of(text), HasSubstr("is no time from 00:00 to 24:00")) << text;
    EXPECT_THAT(complaint_of("open"), HasSubstr("neither a range of time"));
    EXPECT_THAT(complaint_of("09:00-12:00,"), HasSubstr("neither a range of time"));
    EXPECT_THAT(complaint_of("22:00-02:00"), HasSubstr("00:00 on the next day"));
    EXPECT_THAT(complaint_of("09:00-09:00"), HasSubstr("ends before it begins"));
    EXPECT_THAT(complaint_of("09:00-12:00, 12:00-13:00"), HasSubstr("touch or overlap"));
}

TEST(ExceptionDays, AreDaysWithHoursOfTheirOwn) {
    EXPECT_THAT(parse_exceptions(""), IsEmpty());
    EXPECT_THAT(parse_exceptions("2026-12-25 closed; 2026-12-24 09:00-12:00\n2028-02-29"),
                ElementsAre(ExceptionDay{2026y / December / 25, {}},
                            ExceptionDay{2026y / December / 24, {{540, 720}}},
                            ExceptionDay{2028y / February / 29, {{0, 1440}}}));
}

TEST(ExceptionDays, SayWhatIsWrongWithThem) {
    for (const char* text :
         {"2026-02-29 closed", "2026-13-01 closed", "25.12.2026 closed", "2026-12-25closed", "x"})
        EXPECT_THAT(complaint_of_exceptions(text), HasSubstr("is no day")) << text;
    EXPECT_THAT(complaint_of_exceptions("2026-12-25 shut"), HasSubstr("neither a range of time"));
    EXPECT_THAT(complaint_of_exceptions("2026-12-25 closed; 2026-12-25"), HasSubstr("there twice"));
}

}  // namespace
}  // namespace eddy
