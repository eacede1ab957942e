/// Files that are no recordings are refused by what they are, with what to do instead.
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/open_table.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using testing::HasSubstr;
using namespace std::string_literals;

std::string refused_file(const std::string& content) {
  const TemporaryFile file("run.dat", content);
  return refusal([&] { (void)open_sample_table(file.path()); });
}

TEST(ForeignText, IsRefusedByItsKind) {
  for (const auto& [content, kind] : std::vector<std::pair<std::string, std::string>>{
           {"[1, 2, 3]\n", "JSON"},
           {"{\"time\": [0, 1],\n \"current\": [1, 2]}\n", "JSON"},
           {"  [\n  {\"t\": 0, \"i\": 1},\n  {\"t\": 1, \"i\": 2}\n]\n", "JSON"},
           {"<?xml version=\"1.0\"?>\n<run><t>0</t></run>\n", "XML or HTML"},
           {"<!DOCTYPE html>\n<html><body>1,2,3\n4,5,6</body></html>\n", "XML or HTML"},
           {"\xEF\xBB\xBF<html>\n", "XML or HTML"},
           {"#include <cmath>\nconst double t[] = {\n0, 1, 2,\n3, 4, 5,\n};\n", "source code"},
           {"#!/bin/sh\necho 1\n", "source code"},
           {"import numpy as np\nx = [1, 2]\n", "source code"},
           {"from math import sin\nx = 1\n", "source code"},
           {"version https://git-lfs.github.com/spec/v1\noid sha256:1\nsize 12\n", "git lfs pull"},
           {"date Tue Mar 4 10:00:00 2025\nbase hex timestamps absolute\n0.1 1 100 Rx d 8 00 11\n", "bus messages"},
       })
    EXPECT_THAT(refused_file(content), HasSubstr(kind)) << content;
}

TEST(ForeignText, WithoutATableOfNumbersIsRefusedWithWhatToExport) {
  for (const std::string content : {
           "Dear colleague,\nthe valve was measured at 50 bar, as agreed.\nRegards, A. Meyer\n",
           "hello\n",
           "a,b,c\nred,green,blue\nx,y,z\n",
           "# Rig 3\n\nThe oil was cold.\n",
           "[valve]\nname = \"x\"\nstroke = 2\n",
       })
    EXPECT_THAT(refused_file(content),
                testing::AllOf(HasSubstr("holds no table"), HasSubstr("export the recording as CSV")))
        << content;
  EXPECT_THAT(refused_file("time    current   position\n0.000   1.000     1.5\n0.001   1.000     1.5\n"),
              HasSubstr("several blanks part its columns"));
  EXPECT_THAT(refused_file("\x01\x02\x03\x04\x05\x06\x0E\x0F\x10\x11,a\n1,2\n"), HasSubstr("is not text"));
}

TEST(ForeignText, LeavesTablesAlone) {
  for (const std::string content : {
           "current_A\n1\n2\n",
           "time_s,current_A\n",
           "time_s,current_A\n,\n,\n",
           "[s],[A]\n0,1\n",
           "import,time_s\n0,1\n",
           "from_s,to_s\n0,1\n",
           "class,time_s\n0,1\n",
           "LOGGER,time_s\n0,1\n",
       }) {
    const TemporaryFile file("run.csv", content);
    EXPECT_GE(open_sample_table(file.path()).table->columns().size(), 1u) << content;
  }
}

TEST(ForeignFiles, AreRefusedByTheirFirstBytes) {
  for (const auto& [content, kind] : std::vector<std::pair<std::string, std::string>>{
           {"\x89PNG\r\n\x1A\n\0\0"s, "a picture (PNG)"},
           {"\xFF\xD8\xFF\xE0\0\x10JFIF"s, "a picture (JPEG)"},
           {"\x7F"
            "ELF\2\1\1\0"s,
            "a program (ELF)"},
           {"SQLite format 3\0\x10"s, "an SQLite database"},
           {"\x80\x04\x95\x10\0\0"s, "a pickle of Python"},
           {"\x93NUMPY\1\0v\0{'descr': '<f8'}"s, "an array of NumPy (.npy)"},
           {"PK\3\4\x14\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\5\0\0\0a.npy\x93NUMPY"s, "arrays of NumPy (.npz)"},
           {"PAR1\x15\4\x15\0"s, "a Parquet file"},
           {"%PDF-1.7\n", "a PDF document"},
           {"{\\rtf1\\ansi text}\n", "Rich Text Format"},
       })
    EXPECT_THAT(refused_file(content), HasSubstr(kind)) << kind;
}

TEST(ForeignFiles, WhoseBeginningIsDamagedAreRefusedByWhatTheirEndingSays) {
  for (const auto& [ending, kind] : std::vector<std::pair<std::string, std::string>>{
           {".tdms", "TDMS"}, {".mf4", "MDF 4"}, {".h5", "HDF5"}, {".HDF5", "HDF5"}, {".xlsx", "Excel"}}) {
    for (const std::string& content : {std::string(4096, '\0'), "\x89HDE\r\n\x1A\n\0\0\0\1"s, "TDS"s}) {
      const TemporaryFile file("run" + ending, content);
      EXPECT_THAT(refusal([&] { (void)open_sample_table(file.path()); }),
                  testing::AllOf(HasSubstr("run" + ending + ": ends in " + ending + ", but does not begin as " + kind +
                                           " files do: it is damaged or cut off"),
                                 HasSubstr("copy it again from where it was recorded")));
    }
    const TemporaryFile text("run" + ending, "time_s,current_A\n0,1\n0.001,1\n");
    EXPECT_EQ(open_sample_table(text.path()).table->columns().size(), 2u);
  }
}

}  // namespace
}  // namespace spoolflow::recording
