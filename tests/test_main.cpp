#include <skein/arrays/runtime.hpp>

#include <gtest/gtest.h>

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  const skein::Runtime runtime;
  return RUN_ALL_TESTS();
}
