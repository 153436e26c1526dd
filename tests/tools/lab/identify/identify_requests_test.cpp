#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "tests/support/own_folder.h"
#include "tests/support/refusal.h"
#include "tools/lab/identify/csv_table.h"
#include "tools/lab/identify/fragment.h"
#include "tools/lab/identify/identify_recording.h"
#include "tools/lab/identify/text_parts.h"

namespace sprung::identify {
namespace {

using identification::JointTerm;
using testing::ElementsAre;
using testing::HasSubstr;

template <class Call>
std::string refusal(const Call& call) {
  return test::refusal_of<std::exception>([&] { call(); });
}

TEST(SpansText, OneOrSeveral) {
  const auto spans = parse_spans("0:0.25, 0.5:0.75", "--train");
  ASSERT_EQ(spans.size(), 2u);
  EXPECT_EQ(spans[1].from_s, 0.5);
  EXPECT_EQ(spans[1].to_s, 0.75);
  for (const char* wrong : {"", "8", "8:", "9:8", "a:b", "0:1,"})
    EXPECT_THAT(refusal([&] { parse_spans(wrong, "--train"); }), HasSubstr("--train")) << wrong;
}

TEST(ProtocolRequest, SaysWhatTheOptionsSay) {
  ProtocolRequest request;
  request.window = "8:60";
  request.resample_Hz = 100.0;
  request.train = "0:0.5";
  request.test = "0.5:1";
  request.models = "coulomb,viscous+stribeck";
  request.robust = "tukey";
  const identification::Protocol found = protocol_of(request);
  EXPECT_EQ(found.window.from_s, 8.0);
  EXPECT_EQ(found.window.to_s, 60.0);
  EXPECT_EQ(found.prepare.rate_Hz, 100.0);
  EXPECT_EQ(found.search.validation.fit.loss, identification::RobustLoss::kTukey);
  ASSERT_EQ(found.search.only.size(), 2u);
  EXPECT_TRUE(found.search.only[0].empty());
  EXPECT_THAT(found.search.only[1], ElementsAre(JointTerm::kViscous, JointTerm::kStribeck));
}

TEST(ProtocolRequest, TermsMayComeInAnyOrder) {
  EXPECT_EQ(terms_of("load+viscous"), terms_of("viscous+load"));
}

TEST(ProtocolRequest, MistakesNameTheOption) {
  ProtocolRequest request;
  request.train = "0:0.5";
  request.test = "0.5:1";
  const auto with = [&](std::string ProtocolRequest::*member, const char* text) {
    ProtocolRequest wrong = request;
    wrong.*member = text;
    return refusal([&] { protocol_of(wrong); });
  };
  EXPECT_THAT(with(&ProtocolRequest::window, "1:2,3:4"), HasSubstr("--window"));
  EXPECT_THAT(with(&ProtocolRequest::models, "grease"),
              HasSubstr("--models: no term 'grease'; there are coulomb"));
  EXPECT_THAT(with(&ProtocolRequest::robust, "lax"), HasSubstr("--robust lax"));
  EXPECT_THAT(with(&ProtocolRequest::train, "all"), HasSubstr("--train"));
}

TEST(CsvSeries, CurrentBecomesTorqueWhereTheConstantIsKnown) {
  const auto columns = parse_columns("time=1,position=2,current=3");
  const auto amperes = csv_series(columns, {{0, 1}, {2, 3}, {4, 5}}, {100.0, 0.0});
  EXPECT_EQ(amperes.torque_unit, "A");
  EXPECT_EQ(amperes.gear_ratio, 100.0);
  EXPECT_THAT(amperes.measured_torque, ElementsAre(4, 5));
  const auto torque = csv_series(columns, {{0, 1}, {2, 3}, {4, 5}}, {100.0, 0.05});
  EXPECT_EQ(torque.torque_unit, "Nm");
  EXPECT_THAT(torque.measured_torque, ElementsAre(20, 25));
  EXPECT_THAT(torque.position_rad, ElementsAre(2, 3));
}

TEST(CsvSeries, EverySignalFindsItsPlace) {
  const auto columns = parse_columns(
      "time=1,position=2,velocity=3,torque=4,link_position=5,load=6,temperature=7");
  const auto series = csv_series(columns, {{1}, {2}, {3}, {4}, {5}, {6}, {7}}, {});
  EXPECT_EQ(series.torque_unit, "Nm");
  EXPECT_THAT(series.velocity_rad_s, ElementsAre(3));
  EXPECT_THAT(series.measured_torque, ElementsAre(4));
  EXPECT_THAT(series.link_position_rad, ElementsAre(5));
  EXPECT_THAT(series.load_Nm, ElementsAre(6));
  EXPECT_THAT(series.temperature_C, ElementsAre(7));
}

TEST(FootWeight, IsKilogramsWithTheirUnit) {
  EXPECT_EQ(parse_weight_kg("5kg"), 5.0);
  EXPECT_EQ(parse_weight_kg("2.5kg"), 2.5);
  EXPECT_EQ(parse_weight_kg("0"), 0.0);
  for (const char* wrong : {"5", "5lb", "kg", "-1kg", "80kg", ""})
    EXPECT_THAT(test::refusal_of<WrongUse>([&] { (void)parse_weight_kg(wrong); }), HasSubstr("kilograms"))
        << wrong;
}

TEST(GearTemperature, IsDegreesWithOrWithoutTheirUnit) {
  EXPECT_EQ(parse_temperature_C("24degC"), 24.0);
  EXPECT_EQ(parse_temperature_C("-10"), -10.0);
  for (const char* wrong : {"24K", "degC", "200degC", "-60", "nan", ""})
    EXPECT_THAT(test::refusal_of<WrongUse>([&] { (void)parse_temperature_C(wrong); }),
                HasSubstr("--temperature"))
        << wrong;
}

TEST(GearTemperature, OfARoomIsRefusedByItsOwnName) {
  EXPECT_EQ(parse_temperature_C("21degC", "--ambient"), 21.0);
  EXPECT_THAT(test::refusal_of<WrongUse>([] { (void)parse_temperature_C("21F", "--ambient"); }),
              HasSubstr("--ambient 21F"));
}

TEST(GearTemperature, IsOneOfAllRecordingsOrOneOfEach) {
  RecordingRequest request;
  request.logs = {"cold.lcm", "warm.lcm"};
  EXPECT_TRUE(std::isnan(temperature_C(request, 1)));
  request.temperatures = {"24degC"};
  EXPECT_EQ(temperature_C(request, 1), 24.0);
  request.temperatures.push_back("40degC");
  EXPECT_EQ(temperature_C(request, 1), 40.0);
  request.temperatures.push_back("50degC");
  EXPECT_THAT(test::refusal_of<WrongUse>([&] { (void)temperature_C(request, 0); }),
              HasSubstr("3 for 2 recordings"));
}

TEST(FileDigest, IsThePublishedOneOfThreeLetters) {
  const std::string path = test::temp_dir() + "identify_digest.txt";
  std::ofstream(path) << "abc";
  EXPECT_EQ(short_sha256({path}), "ba7816bf8f01cfea");        // FIPS 180-2, appendix B.1
  EXPECT_EQ(short_sha256({path, path}), "bbb59da3af939f7a");  // of abcabc
  EXPECT_THROW(short_sha256({"/nowhere/x"}), std::runtime_error);
}

}  // namespace
}  // namespace sprung::identify
