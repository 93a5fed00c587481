! Scenes shared by the tests.
module scenes
  use hooke
  implicit none

contains

  ! A mass on a spring of the length law: 0.5 kg, 20 N/m, 1 m, pinned at particle 1 and stretched to 1.25 m;
  ! omega^2 = 40.
  subroutine make_oscillator(system, damping)
    type(hooke_system), intent(inout) :: system
    real(hooke_real), intent(in), optional :: damping
    type(hooke_options) :: spring
    real(hooke_real) :: position(3, 2)
    position = 0
    position(1, 2) = 1.25_hooke_real
    call system%create()
    call system%add_particles(position, [1.0_hooke_real, 0.5_hooke_real])
    call system%pin(1)
    call spring%create("springs")
    call spring%set("law", "length")
    call spring%set("stiffness", 20)
    call spring%set("rest_length", 1)
    if (present(damping)) call spring%set("damping", damping)
    call system%add_springs(reshape([1, 2], [2, 1]), spring, "spring")
    call system%commit()
  end subroutine

  ! A cloth of 5 x 5 particles pinned at its corners, with weak bending.
  subroutine make_cloth(system)
    type(hooke_system), intent(inout) :: system
    type(hooke_options) :: cloth
    call system%create()
    call cloth%create("cloth")
    call cloth%set("origin", [0, 0, 0])
    call cloth%set("edges", [1, 0, 0, 0, 0, 1])
    call cloth%set("size", [5, 5])
    call cloth%set("mass", 0.5_hooke_real)
    call cloth%set("pinned", "top-corners")
    call cloth%set("structural.stiffness", 50)
    call cloth%set("structural.damping", 0.05_hooke_real)
    call cloth%set("shear.stiffness", 5)
    call system%add_part("cloth", cloth, "cloth")
    call system%set_gravity([0.0_hooke_real, -9.81_hooke_real, 0.0_hooke_real])
    call system%commit()
  end subroutine

  ! A run of the oscillator, at its beginning.
  subroutine start_oscillator(integrator, state, method, step, duration, every)
    type(hooke_integrator), intent(inout) :: integrator
    type(hooke_state), intent(inout) :: state
    character(*), intent(in) :: method
    real(hooke_real), intent(in) :: step, duration
    real(hooke_real), intent(in), optional :: every
    type(hooke_system) :: system
    type(hooke_options) :: run
    call make_oscillator(system)
    call make_run(run, method, step, duration)
    if (present(every)) call run%set("every", every)
    call integrator%create(system, run)
    call state%create(system)
  end subroutine

  ! The file of a run of the oscillator that ended at its first frame.
  subroutine write_oscillator(path)
    character(*), intent(in) :: path
    type(hooke_system) :: system
    type(hooke_options) :: run
    type(hooke_integrator) :: integrator
    type(hooke_state) :: state
    type(hooke_trajectory) :: trajectory
    call make_oscillator(system)
    call make_run(run, "verlet", 1e-3_hooke_real, 0.1_hooke_real)
    call integrator%create(system, run)
    call state%create(system)
    call trajectory%create(path, system, integrator)
    call trajectory%write(0_hooke_long, state)
    call trajectory%close()
  end subroutine

  subroutine make_run(run, method, step, duration)
    type(hooke_options), intent(inout) :: run
    character(*), intent(in) :: method
    real(hooke_real), intent(in) :: step, duration
    call run%create("run")
    call run%set("method", method)
    call run%set("step", step)
    call run%set("duration", duration)
  end subroutine
end module
