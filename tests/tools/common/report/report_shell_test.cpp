#include "tools/common/report/report_shell.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/tools/common/report/report_folder.h"

namespace sprung::report {
namespace {

TEST(WriteReport, MakesFoldersAndReplacesWhatWasThere) {
  const ReportFolder folder;
  const auto path = folder.path / "deep" / "er" / "report.html";
  Report report{"A title that is longer than the second one"};
  write_report(report, path);
  report.title = "Second";
  write_report(report, path);
  EXPECT_EQ(file_text(path), to_html(report));
}

TEST(WriteReport, SaysWhichFileAndWhyNot) {
  const ReportFolder folder;
  std::ofstream(folder.path / "file") << "in the way";
  try {
    write_report(Report{"Title"}, folder.path / "file" / "report.html");
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("file/report.html"),
                                             testing::HasSubstr("Not a directory")));
  }
  std::filesystem::create_directory(folder.path / "report.html");
  EXPECT_THROW(write_report(Report{"Title"}, folder.path / "report.html"), std::runtime_error);
}

}  // namespace
}  // namespace sprung::report
