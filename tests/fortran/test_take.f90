! Some particles of a system have its forces to the bit, and a motion begins at a step of another.
program test_take
  use check
  use hooke
  use scenes
  implicit none
  type(hooke_system) :: system, part
  type(hooke_state) :: state
  type(hooke_options) :: run
  type(hooke_integrator) :: integrator, late
  real(hooke_real) :: q(3, 25), v(3, 25), whole(3, 25), forces(3, 15)
  integer :: k, status
  call make_cloth(system)
  q = reshape([(sin(0.7_hooke_real*k), k=1, 75)], [3, 25])
  v = reshape([(cos(1.3_hooke_real*k), k=1, 75)], [3, 25])
  call system%take_particles([(k, k=1, 15)], part)
  call system%force(0.0_hooke_real, q, v, whole)
  call part%force(0.0_hooke_real, q(:, :15), v(:, :15), forces)
  call expect(same_count(reshape(forces(:, :10), [30]), reshape(whole(:, :10), [30])) == 30, "two inner rows")
  call expect(any(abs(forces(:, 11:) - whole(:, 11:15)) > 0.01_hooke_real), "the third row lacks the fourth")
  call system%take_particles([2, 1], part, status)
  call expect(status == hooke_bad_value, "not ascending")
  call make_run(run, "rk4", 1e-3_hooke_real, 0.1_hooke_real)
  call integrator%create(system, run)
  call late%create(system, run)
  call state%create(system)
  call integrator%step(state, 7)
  call late%begin(state, 0.0_hooke_real, 7_hooke_long)
  call late%begin(state, 0.0_hooke_real, 8_hooke_long, status)
  call expect(status == hooke_bad_value, "another time than that of the step")
  call finish()
end program
