#include "isoatlas/environment.h"

#include <utility>

#include "isoatlas/context.h"

namespace isoatlas {
namespace {

constexpr Environment kOfProcess;
constinit thread_local const Environment* current = &kOfProcess;

}  // namespace

const Environment& current_environment() noexcept { return *current; }

EnvironmentScope::EnvironmentScope(const Environment& environment) noexcept
    : environment_(environment), before_(std::exchange(current, &environment_)) {}

EnvironmentScope::EnvironmentScope(const Context& context) noexcept
    : EnvironmentScope(context.environment != nullptr ? *context.environment : *current) {}

EnvironmentScope::~EnvironmentScope() { current = before_; }

}  // namespace isoatlas
