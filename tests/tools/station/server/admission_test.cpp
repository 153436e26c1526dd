#include "tools/station/server/admission.h"

#include <gtest/gtest.h>

namespace sprung::station {
namespace {

const Doorkeeper kDoor("0123abcd", {"https://app.foxglove.dev"});

Admission judge(const char* host, const char* origin = "", const char* path = "/0123abcd/main.js") {
  return kDoor.judge({host, origin, path});
}

TEST(Doorkeeper, AdmitsThisMachinesOwnNamesWithTheToken) {
  for (const char* host : {"127.0.0.1:8137", "localhost:8137", "[::1]:8137", "localhost"})
    EXPECT_EQ(judge(host), Admission::kAdmitted) << host;
  EXPECT_EQ(judge("127.0.0.1:8137", "http://127.0.0.1:8137"), Admission::kAdmitted);
}

TEST(Doorkeeper, RefusesANameThatWasReboundToThisMachine) {
  for (const char* host : {"evil.com:8137", "", "127.0.0.1.evil.com", "localhost.evil.com:8137",
                           "192.168.0.7:8137", "[::1].evil.com", "[fe80::1]:8137", "0.0.0.0:8137"})
    EXPECT_EQ(judge(host), Admission::kForeignHost) << host;
}

TEST(Doorkeeper, RefusesPagesOfAnotherOriginUnlessTheyAreNamed) {
  for (const char* origin : {"http://evil.com", "null", "https://127.0.0.1:8137", "http://127.0.0.1:9999",
                             "http://localhost:8137", "file://"})
    EXPECT_EQ(judge("127.0.0.1:8137", origin), Admission::kForeignOrigin) << origin;
  EXPECT_EQ(judge("127.0.0.1:8137", "https://app.foxglove.dev"), Admission::kAdmitted);
}

TEST(Doorkeeper, RefusesAPathWithoutTheToken) {
  for (const char* path :
       {"/", "", "/0123abc/", "/0123abcde/", "/main.js", "0123abcd/", "//0123abcd/", "/0123ABCD/"})
    EXPECT_EQ(judge("localhost:1", "", path), Admission::kWrongToken) << path;
}

TEST(Doorkeeper, TellsWhatFollowsTheToken) {
  EXPECT_EQ(kDoor.inner_path("/0123abcd/lib/three.js"), "lib/three.js");
  EXPECT_EQ(kDoor.inner_path("/0123abcd/"), "");
  EXPECT_EQ(kDoor.inner_path("/0123abcd"), "");
}

}  // namespace
}  // namespace sprung::station
