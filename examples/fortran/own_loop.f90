! A time loop of one's own: a mass on a spring is let go, until it has lost nine tenths of its energy.
program own_loop
  use hooke
  implicit none
  type(hooke_system) :: system
  type(hooke_options) :: spring, run
  type(hooke_integrator) :: integrator
  type(hooke_state) :: state
  real(hooke_real) :: position(3, 2), start

  position = 0
  position(1, 2) = 1.25_hooke_real
  call system%create()
  call system%add_particles(position, [1.0_hooke_real, 0.5_hooke_real]) ! kg
  call system%pin(1)
  call spring%create("springs")
  call spring%set("stiffness", 20)            ! N
  call spring%set("damping", 0.3_hooke_real)  ! N s
  call spring%set("rest_length", 1)           ! m
  call system%add_springs(reshape([1, 2], [2, 1]), spring, "spring")
  call system%commit()

  call run%create("run") ! symplectic-euler, unless told otherwise
  call run%set("step", 1e-3_hooke_real)
  call integrator%create(system, run)
  call state%create(system)
  start = system%energy("total", state%q, state%v)
  do while (system%energy("total", state%q, state%v) > 0.1_hooke_real*start)
    call integrator%step(state, 10)
  end do
  print "(a, g0.3, a, g0.3, a)", "nine tenths of ", start, " J are gone after ", state%time(), " s"
end program
