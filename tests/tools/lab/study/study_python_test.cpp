#include "tools/lab/study/study_python.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace sprung {
namespace {

using testing::HasSubstr;

TEST(StudyPython, SaysWhatIsMissingAndWhatToDo) {
  setenv("SPRUNG_PYTHON", "/no/such/python", 1);
  const std::string said = run_study_python({"parquet", "/nowhere"});
  unsetenv("SPRUNG_PYTHON");
  EXPECT_FALSE(said.empty());
  EXPECT_THAT(said, HasSubstr("/no/such/python"));
}

TEST(StudyPython, SaysWhatThePythonPartSaid) {
  EXPECT_FALSE(run_study_python({"parquet", "/nowhere"}).empty());
}

}  // namespace
}  // namespace sprung
