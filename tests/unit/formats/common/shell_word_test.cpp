#include "isoatlas/shell_word.h"

#include <gtest/gtest.h>

namespace isoatlas {
namespace {

TEST(ShellWord, IsOneWordThatShowsItsBytes) {
    EXPECT_EQ(shell_word("Sch\xe4"
                         "del's.nrrd"),
              "$'Sch\\344del\\'s.nrrd'");
    EXPECT_EQ(shell_word("plain name"), "'plain name'");
    EXPECT_EQ(shell_word("Sch\xc3\xa4"
                         "del"),
              "'Sch\xc3\xa4"
              "del'");
}

}  // namespace
}  // namespace isoatlas
