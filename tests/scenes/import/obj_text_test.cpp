#include "scenes/import/obj_text.h"

#include <gtest/gtest.h>

#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

std::string problemIn(const std::string& obj) {
  try {
    takeApart(obj);
  } catch (const sim::InputError& error) {
    return error.what();
  }
  return "none";
}

constexpr const char* kCorners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(ObjText, KeepsShapesAndKnowsWhatTheyBelongTo) {
  const ObjText obj = takeApart(
      "# a comment\nmtllib paint.mtl\nv 0 0 0\nv 1 0 0 # second\nvn 0 0 1\nvt 0 0\nv 0 1 0\nf 1//1 2//1 "
      "3//1\n"
      "o south wall \nusemtl red\ns 1\nf 1/1 2/1 3/1\nf -3 -2 -1\nl 1 2\nf 1 2\ng b\nf 1 2 3\no south wall\n"
      "usemtl red\nf 1 2 3\nmtllib paint.mtl\n");
  EXPECT_EQ(obj.shapes, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\nf 1 2 3\nf 1 2 3\nf 1 2 3\n");
  EXPECT_EQ(obj.polygons, 5u);
  ASSERT_EQ(obj.stretches.size(), 4u);
  const char* const groups[] = {"", "south wall", "b", "south wall"};
  const char* const materials[] = {"", "red", "red", "red"};
  const std::uint64_t first[] = {0, 1, 3, 4};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(obj.stretches[i].group, groups[i]);
    EXPECT_EQ(obj.stretches[i].material.name, materials[i]);
    EXPECT_EQ(obj.stretches[i].first_polygon, first[i]);
  }
  EXPECT_EQ(obj.stretches[1].material.line, 10);
  EXPECT_EQ(obj.stretches[1].material.column, 8);
  ASSERT_EQ(obj.libraries.size(), 1u);
  EXPECT_EQ(obj.libraries[0].name, "paint.mtl");
  EXPECT_EQ(obj.libraries[0].line, 2);
}

TEST(ObjText, ReadsWhatOtherProgramsWrite) {
  const std::string shapes = "v 0.5 -.5 1e-3\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  for (const std::string obj : {
           "\xef\xbb\xbfv .5 -.5 1e-3\nv 1 0 0\nv 0 1 0\nf 1 2 3",  // a byte order mark, no end of line
           "v .5 -.5 1e-3\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",    //
           "v .5 -.5 1e-3\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",            //
           "  v\t.5  -.5\t1e-3 \n\tv 1 0 0\nv 0 1 0\n f 1 2 3 # a face\n",          // indented
           "v .5 -.5 \\\n 1e-3\nv 1 0 0\nv 0 1 0\nf 1 \\\r\n2 \\\r\n3\n",           // over several lines
           "# of C:\\meshes\\\nv .5 -.5 1e-3\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",         // a comment alone
           "v .5 -.5 1e-3 0.1 0.2 0.3\nv 1 0 0 1 1 1\nv 0 1 0 0 0 0 1\nf 1 2 3\n",  // colours
           "f 1 2 3\nv .5 -.5 1e-3\nv 1 0 0\nv 0 1 0\n",                            // faces first
       }) {
    const ObjText text = takeApart(obj);
    EXPECT_EQ(text.polygons, 1u) << obj;
    if (obj.starts_with('f')) continue;
    EXPECT_EQ(text.shapes, shapes) << obj;
  }
  EXPECT_EQ(takeApart("v 1 2 3 2\n").shapes, "v 1 2 3 2\n");  // a weight
}

TEST(ObjText, SaysWhichLineIsWrong) {
  const std::string triangle = kCorners;
  EXPECT_EQ(problemIn("v 0 0\n"), "line 1: a vertex has 2 numbers; expected three: x, y and z");
  EXPECT_EQ(problemIn("v 0 0 zero\n"), "line 1: 'zero' is not a finite number");
  for (const std::string word :
       {"nan", "inf", "1e39", "1e4294967297", "1.2.3", "1-2", "1e", "+-1", "-", "1.#IND"})
    EXPECT_EQ(problemIn("v 0 " + word + " 0\n"), "line 1: '" + word + "' is not a finite number");
  EXPECT_EQ(problemIn("v 0 0 0x10\n"), "line 1: '0x10' is not a finite number");
  EXPECT_EQ(problemIn(triangle + "f 1 2 4\n"),
            "line 4: a face asks for vertex 4, which is out of range: there are 3");
  EXPECT_EQ(problemIn(triangle + "\nf 1 2 -4\nv 0 0 0\n"),
            "line 5: a face asks for vertex -4, which is out of range: there are 3");
  EXPECT_EQ(problemIn(triangle + "f 1 2 -9223372036854775808\n"),
            "line 4: a face asks for vertex -9223372036854775808, which is out of range: there are 3");
  EXPECT_EQ(problemIn(triangle + "f 0 1 2\n"), "line 4: a face asks for vertex 0; they are counted from 1");
  EXPECT_EQ(problemIn(triangle + "f 1 2 b\n"), "line 4: 'b' is not the number of a vertex");
  EXPECT_EQ(problemIn(triangle + "f 1 2 99999999999999999999\n"),
            "line 4: '99999999999999999999' is not the number of a vertex");
}

}  // namespace
}  // namespace espalier::scenes
