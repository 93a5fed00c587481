// A mass on a spring from C++17: objects in unique_ptr, statuses as exceptions, a force that is a lambda. Prints the version
// and returns 0 if the mass falls as it has to.
#include <hooke.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <type_traits>

template <auto destroy> struct destroyed_by {
  template <class T> void operator()(T *object) const {
    destroy(object);
  }
};
using system_ptr = std::unique_ptr<hooke_system, destroyed_by<hooke_system_destroy>>;
using state_ptr = std::unique_ptr<hooke_state, destroyed_by<hooke_state_destroy>>;
using options_ptr = std::unique_ptr<hooke_options, destroyed_by<hooke_options_destroy>>;
using integrator_ptr = std::unique_ptr<hooke_integrator, destroyed_by<hooke_integrator_destroy>>;

static void check(int32_t status) {
  if (status < 0) throw std::runtime_error(hooke_last_error());
}

template <class Ptr, class Create, class... Arguments>
static Ptr make(Create create, Arguments... arguments) {
  typename Ptr::pointer object = nullptr;
  check(create(arguments..., &object));
  return Ptr(object);
}

static double height_after_a_second() {
  const double position[] = {0, 0, 0}, mass = 2, weight = -2 * 9.81;
  auto system = make<system_ptr>(hooke_system_create);
  check(hooke_system_add_particles(system.get(), 1, position, nullptr, 1, &mass, nullptr));
  check(hooke_system_set_force(
      system.get(),
      [](int64_t, double, const double *, const double *, double *force, void *ctx) -> int32_t {
        force[1] += *static_cast<const double *>(ctx);
        return 0;
      },
      nullptr, const_cast<double *>(&weight)));
  check(hooke_system_commit(system.get()));
  auto run = make<options_ptr>(hooke_options_create, "run");
  check(hooke_options_set_text(run.get(), "method", "verlet"));
  check(hooke_options_set_number(run.get(), "step", 0.125));
  check(hooke_options_set_number(run.get(), "duration", 1));
  auto integrator = make<integrator_ptr>(hooke_integrator_create, system.get(), run.get());
  auto state = make<state_ptr>(hooke_state_create, system.get());
  check(hooke_integrator_run(integrator.get(), state.get()));
  return hooke_state_position(state.get())[1];
}

int main() try {
  auto run = make<options_ptr>(hooke_options_create, "run");
  bool refused = false;
  try {
    check(hooke_options_set_number(run.get(), "step", -1));
  } catch (const std::runtime_error &) {
    refused = true;
  }
  const double y = height_after_a_second();
  std::printf("%s %.17g\n", hooke_version(), y);
  return !refused || std::fabs(y + 9.81 / 2) > 1e-12;
} catch (const std::exception &failure) {
  std::fprintf(stderr, "%s\n", failure.what());
  return 1;
}
