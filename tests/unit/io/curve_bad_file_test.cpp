#include "unit/io/curve_round_trip.hpp"

namespace vspring::curve_bad_file_test {
namespace {

class CurveBadFile : public CurveScratch {};

struct Case {
  std::string name;
  std::string bytes;
  std::string message;  ///< how it begins, after the path
};

std::vector<Case> cases() {
  const std::string no_rows = ": no row of two or three numbers is in it";
  return {
      {"a.obj", "v 0 0 0\nv 1 0 zero\nl 1 2\n", ":2: 'zero' stands where a coordinate belongs"},
      {"a.obj", "v 0 0\nl 1 2\n", ":1: the line ends where a coordinate belongs"},
      {"a.obj", "v 0 0 0\nv 1 0", ":2: the file ends where a coordinate belongs; it is cut off"},
      {"a.obj", "v 0 0 0\n", ": it has no lines (statements that begin with l); choose an OBJ file of a curve"},
      {"a.obj", "hello\n", ": it has no lines"},
      {"a.obj", "v 0 0 0\nf 1 1 1\n",
       ": it has no lines (statements that begin with l) but faces; use `vspring fair` for a surface"},
      {"a.obj", "v 0 0 0\nl 1 2\nl 1 7\n", ":3: node 7 does not exist, the file has 1"},
      {"a.obj", "v 0 0 0\nl 1 99999999999999\n", ":2: node 1073741825 does not exist"},
      {"a.obj", "v 0 0 0\nl 1 0\n", ":2: node 0 does not exist; OBJ counts from 1"},
      {"a.obj", "v 0 0 0\nl -1 -2\n", ":2: node -2 does not exist, 1 stand above"},
      {"a.obj", "v 0 0 0\nl 1 1\n", ": its lines lead from nodes to themselves"},
      {"a.obj", "v 0 0 0\nl 1\n", ":2: the line ends where the number of a node belongs"},
      {"a.obj", "v 0 0 0\nl 1", ":2: the file ends where the number of a node belongs; it is cut off"},
      {"a.obj", "v 0 0 0\nl 1 1x\n", ":2: 'x' stands where the next node of the line belongs"},
      {"a.obj", "v 0 0 0\nl 1/2/3 1\n", ":2: '/3' stands where the next node of the line belongs"},
      {"a.csv", "0,0\n1,zero\n", ":2: 'zero' stands where y belongs; repair the line"},
      {"a.csv", "0,zero\n1,1\n", ":1: a node needs two or three numbers, this row has fewer"},
      {"a.csv", "x,y,z\n0,0,0\n# c\n1,1\n", ":4: the line ends where z belongs; repair the line"},
      {"a.csv", "x,y\n0,0\n1,", ":3: nothing stands where y belongs; repair the line"},
      {"a.csv", "x,y\n0,0\n1", ":3: the file ends where y belongs; it is cut off"},
      {"a.csv", "x,y\nmm,mm\nof,it\n0,0\n", ":2: 'mm' stands where x belongs"},
      {"a.csv", "x,y\n", no_rows},
      {"a.csv", "\n \n", no_rows},
      {"a.csv", "# x\n", no_rows},
      {"a.csv", "x,y\n0,0\n", ": no two of its nodes follow each other"},
      {"a.csv", "0,0\n\n1,1\n", ": no two of its nodes follow each other"},
      {"a.csv", "hello\nworld\n", ":2: a node needs two or three numbers, this row has fewer"},
      {"a.csv", "0,5 1,5\n1,5 2,5\n",
       ":1: its numbers have decimal commas, and blanks between them; write decimal points"},
      {"a.csv", "0.5;1\n2.5;3\n4,5;6\n", ":3: '4,5' stands where x belongs; write decimal points, not commas"},
      {"a.csv", "0,5;1\n2,5;3\n4.5;6\n", ":3: '4.5' stands where x belongs; write a decimal comma, as other rows do"},
      {"a.csv", "0,5;1\n1.234,5;6\n", ":2: '1.234,5' stands where x belongs; repair the line"},
      {"a.csv", "x,y\n0,41,-0,02\n1,25,0,5\n",
       ":2: its numbers seem to have decimal commas, and commas stand between them, too; write decimal points, "
       "separate "
       "the numbers by semicolons, or choose columns by number if all numbers are whole"},
      {"a.csv", "0,41,-0,02\n1,25,0,05\n", ":1: its numbers seem to have decimal commas"},
      {"a.csv", "x,y,note\n0,0,\"two\nlines\"\n1,1,one\n",
       ":2: a cell in quotes goes on in the next line; write it in one line"},
      {"a.csv", "\"x\n[mm]\",\"y\n[mm]\"\n0,0\n1,1\n", ":1: a cell in quotes goes on in the next line"},
      {"a.csv",
       std::string("\xff\xfe"
                   "0\0,\0"
                   "1\0",
                   8),
       ": is in UTF-16; save it in UTF-8"},
      {"a.csv",
       std::string("\xfe\xff"
                   "\0"
                   "0\0,\0"
                   "1",
                   8),
       ": is in UTF-16; save it in UTF-8"},
      {"a.csv", "no,right,forward\n1,0,0\n2,1,0\n3,1,1\n",
       ":1: column 1 counts rows and no columns are named x and y, so columns 1, 2, 3 cannot be told apart; name them "
       "x, y "
       "and z, or choose columns, such as 2,3"},
      {"a.csv", "t,a,b,c\n5,0,0,1\n5,1,0,1\n",
       ":1: no columns are named x and y, so columns 1, 2, 3, 4 cannot be told apart; name them x, y and z, or choose"},
      {"a.csv", "0,5,5,5\n1,6,5,6\n2,6,6,7\n",
       ":1: column 1 counts rows, so columns 1, 2, 3, 4 cannot be told apart; choose columns, such as 2,3,4"},
      {"a.csv", "x [mm],x [in],y\n1,2,3\n4,5,6\n", ":1: 'x [mm]' and 'x [in]' may both be x; rename one, or choose"},
      {"a.xyz", "0 0 0\n1 1\n", ":2: the line ends where z belongs"},
      {"a.xyz", "0 0\n1 1 1\n", ":2: this row has three numbers, the first row has two; correct one of them"},
      {"a.xyz", "0 0 0\n1 0 0 \n1 0", ":3: the file ends where z belongs; it is cut off"},
      {"a.xyz", "3\nwater\nH 0 0 0\n", ":1: the line ends where y belongs"},
      {"a.xyz", "x y z\n0 0 0\n", ": no two of its nodes follow each other"},
      {"a.xyz", "x y z\n0 0 0\n1 1\n", ":3: the line ends where z belongs"},
      {"a.xyz", "0,0\n1,1\n", ":1: '0,0' stands where x belongs; write decimal points, not commas"},
      {"a.xyz", "0 0 0\n", ": no two of its nodes follow each other"},
      {"a.xyz", "\n", no_rows},
      {"a.dat", "name\n", no_rows},
      {"a.dat", "name\nmore\nzero\n", ":2: 'more' stands where x belongs"},
      {"a.dat", "name\n1 zero\n0 0\n", ":2: 'zero' stands where y belongs"},
      {"a.dat", "name\n0 0\n1\n", ":3: the line ends where y belongs"},
      {"a.dat", "name\n0 0\n1 zero\n", ":3: 'zero' stands where y belongs"},
      {"a.dat", "name\n0 0 0\n1 1 1\n", ":2: a third number, where an aerofoil has x and y; name another format"},
      {"a.dat", "name\n3. 3.\n\n0 0\n1 0\n\n0 0\n1 0\n",
       ":2: this line counts 3 and 3 points, but 4 follow; correct the counts"},
      {"a.svg", "<svg/>\n", ": SVG is a picture, it can only be written"},
      {"a.txt", "ply\nformat ascii 1.0\n", ": its content is PLY, which holds surfaces; use `vspring fair` for it"},
      {"a.txt", "", ": is empty"},
      {"a.csv", "", ": is empty"},
  };
}

TEST_F(CurveBadFile, IsRefusedInOneLineThatSaysWhereAndWhat) {
  for (const Case& bad : cases()) {
    SCOPED_TRACE(bad.bytes);
    const std::string message = message_of([&] { std::ignore = read_curve(put(bad.name, bad.bytes)); });
    EXPECT_EQ(message.substr(0, bad.name.size() + bad.message.size()), bad.name + bad.message);
    EXPECT_NE(message.find(';'), std::string::npos) << "says what to do: " << message;
  }
}

TEST_F(CurveBadFile, MayBeCutOffAnywhere) {
  const std::vector<std::pair<std::string, std::string>> whole = {
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 2 1 0\nl 1/1 2/1 3\nl 3 1\n"},
      {"a.csv", "\xEF\xBB\xBF\"x\", y ;\"z\"\n1.5,2,\"3\"\n\n4,5e1,6\n7,8,9\n"},
      {"a.xyz", "# c\n1 2 3 a\n4 5 6\n\n7 8 9\n"},
      {"a.dat", "name\n2. 3.\n\n0 0\n1 0\n\n0 0\n0.5 -0.1\n1 0\n"},
  };
  for (const auto& [name, text] : whole) {
    for (std::size_t length = 0; length <= text.size(); ++length) {
      try {
        const CurveFile file = read_curve(put(name, text.substr(0, length)));
        write_curve(path("out" + name.substr(1)), file, file.curve.positions());
        EXPECT_EQ(get("out" + name.substr(1)), text.substr(0, length));
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::unusable_file) << error.what();
      }
    }
  }
}

TEST_F(CurveBadFile, MayBeAMillionZeros) {
  std::string zeros;
  zeros.resize(1'000'000);
  for (const std::string name : {"a.obj", "a.csv", "a.dat", "a.xyz", "a.txt", "a"}) {
    const std::string message = message_of([&] { std::ignore = read_curve(put(name, zeros)); });
    EXPECT_LT(message.size(), 200U);
    EXPECT_EQ(message.find('\0'), std::string::npos);
  }
}

TEST_F(CurveBadFile, MayBeMissingOrAFolderOrForbidden) {
  EXPECT_EQ(message_of([&] { std::ignore = read_curve(path("none.csv")); }).substr(0, 52),
            "none.csv: cannot be read: No such file or directory;");
  std::filesystem::create_directory(path("folder.csv"));
  EXPECT_EQ(message_of([&] { std::ignore = read_curve(path("folder.csv")); }).substr(0, 43),
            "folder.csv: cannot be read: Is a directory;");
  if (::geteuid() == 0) return;  // root may read everything
  std::filesystem::permissions(put("secret.csv", "0,0\n1,1\n"), std::filesystem::perms::none);
  EXPECT_EQ(message_of([&] { std::ignore = read_curve(path("secret.csv")); }).substr(0, 46),
            "secret.csv: cannot be read: Permission denied;");
}

}  // namespace
}  // namespace vspring::curve_bad_file_test
