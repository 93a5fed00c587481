! Arrays are the library's own memory.
program test_views
  use, intrinsic :: iso_c_binding, only: c_associated, c_loc, c_ptr
  use check
  use hooke
  use hooke_c_state, only: c_state_position, c_state_velocity
  use hooke_c_system, only: c_system_mass
  use scenes
  implicit none
  type(hooke_system) :: system
  type(hooke_state) :: state, other
  type(hooke_options) :: run
  type(hooke_integrator) :: integrator
  real(hooke_real), pointer, contiguous :: q(:, :), v(:, :), mass(:)
  type(c_ptr) :: place

  call make_oscillator(system)
  call state%create(system)
  q => state%q
  v => state%v
  call expect(all(shape(q) == [3, 2]) .and. size(state%x) == 6, "shapes")
  call expect(c_associated(c_loc(q), c_state_position(state%address())), "positions")
  call expect(c_associated(c_loc(v), c_state_velocity(state%address())), "velocities")
  call expect(c_associated(c_loc(state%x), c_loc(q)), "and the list of them")
  mass => system%mass()
  call expect(c_associated(c_loc(mass), c_system_mass(system%address())), "masses")

  place = c_loc(q)
  call at_place(q, place)
  call make_run(run, "rk4", 1e-3_hooke_real, 0.1_hooke_real)
  call integrator%create(system, run)
  q(2, 2) = 0.5_hooke_real
  call expect(system%energy("springs", q) > 1.0_hooke_real, "what is written is what is asked about")
  call integrator%run(state)
  call expect(abs(q(2, 2) - 0.5_hooke_real) > 1e-3_hooke_real, "a run writes where the view is")
  call expect(c_associated(c_loc(state%q), place), "which stays")

  other = state
  other%q(3, 2) = 7
  call expect(same(state%q(3, 2), 7.0_hooke_real), "assignment is another name")
  call other%create(system)
  call state%copy_to(other)
  other%q(3, 2) = 8
  call expect(same(state%q(3, 2), 7.0_hooke_real), "copy_to() copies")
  call other%destroy()
  call expect(.not. associated(other%q) .and. .not. associated(other%x), "no view of what is gone")
  call expect(associated(state%q), "but of what is there")
  call finish()

contains

  ! Contiguous dummy arguments are not copied either.
  subroutine at_place(array, place)
    real(hooke_real), intent(in), target, contiguous :: array(:, :)
    type(c_ptr), intent(in) :: place
    call expect(c_associated(c_loc(array), place), "passed on without a copy")
  end subroutine
end program
