#include "base/systematic_sample.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

namespace isoatlas {
namespace {

/// The item in which the middle of each part lies, by a walk over all weights. Weights and parts are small whole numbers: no sum rounds.
std::vector<std::int64_t> items_of_parts(const std::vector<int>& weights, int part) {
    std::vector<std::int64_t> items;
    std::int64_t before = 0;  // twice the sum
    for (std::size_t i = 0; i < weights.size(); ++i) {
        before += 2 * weights[i];
        while ((2 * std::ssize(items) + 1) * part < before) items.push_back(static_cast<std::int64_t>(i));
    }
    return items;
}

TEST(SystematicSample, IsTheItemOfEachPartForAnyNumberOfThreads) {
    std::mt19937_64 random(11);
    for (const std::size_t items : {0U, 1U, 5U, 4096U, 4097U, 30'000U}) {
        for (const int largest : {0, 1, 3, 40}) {
            std::vector<int> weights(items);
            for (int& weight : weights) weight = random() % 3 == 0 ? 0 : static_cast<int>(random() % (largest + 1U));
            for (const int part : {1, 2, 7, 100, 100'000}) {
                const std::vector<std::int64_t> expected = items_of_parts(weights, part);
                for (const int threads : {1, 3}) {
                    const SystematicSample sample(std::ssize(weights), threads, [&](std::int64_t i) { return double(weights[i]); });
                    ASSERT_EQ(sample.count(part), std::ssize(expected));
                    std::vector<std::int64_t> chosen(expected.size(), -1);
                    sample.for_each(part, [&](std::int64_t i, std::int64_t k) { chosen[k] = i; });
                    ASSERT_EQ(chosen, expected);
                }
            }
        }
    }
}

}  // namespace
}  // namespace isoatlas
