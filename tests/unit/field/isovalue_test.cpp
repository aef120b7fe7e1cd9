// A decimal that names a sample is that sample.
#include "isoatlas/isovalue.h"

#include <gtest/gtest.h>

namespace isoatlas {
namespace {

VolumeInfo info_of(ValueType type, double slope = 1, double intercept = 0) {
    VolumeInfo info;
    info.type = type;
    info.calibration = {slope, intercept};
    return info;
}

TEST(Isovalue, ADecimalThatNamesAFloatIsThatFloat) {
    const VolumeInfo info = info_of(ValueType::f32);
    for (const float sample : {0.1F, 0.7F, 1e-30F, -3.3F, 16777216.0F})
        EXPECT_EQ(stored_isovalue(info, static_cast<double>(sample)), static_cast<double>(sample));
    EXPECT_EQ(stored_isovalue(info, 0.7), static_cast<double>(0.7F));
    EXPECT_NE(0.7, static_cast<double>(0.7F));
    EXPECT_EQ(stored_isovalue(info, 0.7000000001), 0.7000000001);  // between samples
    EXPECT_EQ(stored_isovalue(info_of(ValueType::f64), 0.7), 0.7);
}

TEST(Isovalue, ACalibratedDecimalIsTheSampleThatIsPrintedLikeThat) {
    const VolumeInfo info = info_of(ValueType::i16, 0.1, -3.7);
    for (int sample = -3000; sample < 3000; ++sample) EXPECT_EQ(stored_isovalue(info, info.calibration.reported(sample)), sample);
    EXPECT_NEAR(stored_isovalue(info, 0.05), 37.5, 1e-9);  // half way between samples
}

TEST(Isovalue, WholeSamplesStayWhole) {
    const VolumeInfo info = info_of(ValueType::u8);
    EXPECT_EQ(stored_isovalue(info, 60), 60);
    EXPECT_EQ(stored_isovalue(info, 60.5), 60.5);
    EXPECT_EQ(stored_isovalue(info, -0.0), 0);
    EXPECT_EQ(stored_isovalue(info, 1e300), 1e300);
}

}  // namespace
}  // namespace isoatlas
