! Objects are released once, for any assignment and any order of destruction.
module holders
  use hooke
  implicit none
  type :: own_type
    type(hooke_system) :: system
    type(hooke_state), allocatable :: states(:)
  end type
end module

program test_handles
  use check
  use holders
  use hooke
  use scenes
  implicit none
  integer :: k

  do k = 1, 3 ! a leftover of one turn would show in the next
    call assignments()
    call keeping()
    call arrays()
    call containers()
    call components()
  end do
  call finish()

contains

  subroutine assignments()
    type(hooke_system) :: a, b, c
    call expect(.not. a%exists(), "nothing at first")
    b = a
    call expect(.not. b%exists(), "nothing is assigned")
    call make_oscillator(a)
    b = a
    call itself(b)
    call expect(b%particle_count() == 2, "assigned to itself")
    c = b
    call a%destroy()
    call expect(.not. a%exists() .and. b%particle_count() == 2, "the other names have it")
    call a%destroy()
    call make_cloth(a)
    b = a
    call expect(b%particle_count() == 25 .and. c%particle_count() == 2, "each has its own")
    call a%create()
    call expect(a%particle_count() == 0 .and. b%particle_count() == 25, "created anew")
  end subroutine

  subroutine itself(system)
    type(hooke_system), intent(inout), target :: system
    type(hooke_system), pointer :: same_one
    same_one => system
    system = same_one
  end subroutine

  ! Objects made from a system keep it alive.
  subroutine keeping()
    type(hooke_integrator) :: integrator
    type(hooke_options) :: options
    type(hooke_state) :: state
    call start_oscillator(integrator, state, "verlet", 1e-3_hooke_real, 0.1_hooke_real)
    call integrator%run(state)
    call expect(integrator%count("steps") == 100, "it runs after its system went out of sight")
    options = integrator%options
    call integrator%destroy()
    call expect(options%text("method") == "verlet", "and its options are there after it was destroyed")
    call expect(.not. integrator%options%exists(), "under the other name")
  end subroutine

  subroutine arrays()
    type(hooke_state) :: some(3)
    type(hooke_state), allocatable :: more(:)
    type(hooke_system) :: system
    integer :: j
    call make_oscillator(system)
    do j = 1, 3
      call some(j)%create(system)
      call some(j)%set_time(real(j, hooke_real))
    end do
    allocate (more(4))
    more(2:) = some
    call expect(.not. more(1)%exists(), "not the first")
    call expect(same(more(4)%time(), 3.0_hooke_real), "but the last")
    deallocate (more)
    call expect(same(some(3)%time(), 3.0_hooke_real), "which is there without the other array")
  end subroutine

  subroutine containers()
    type(own_type) :: mine
    call make_oscillator(mine%system)
    allocate (mine%states(2))
    call mine%states(1)%create(mine%system)
    call mine%states(2)%create(mine%system)
    mine%states(1) = mine%states(2)
    call expect(mine%states(1)%size() == 6, "handles in a type of one's own")
    call move(mine)
  end subroutine

  subroutine move(mine)
    type(own_type), intent(inout) :: mine
    type(hooke_state), allocatable :: states(:)
    call move_alloc(mine%states, states)
    call expect(states(2)%size() == 6, "moved")
  end subroutine

  ! A type that is copied as a whole: if a compiler copies it bit by bit, nothing is released twice.
  subroutine components()
    type(own_type) :: first, second
    call make_oscillator(first%system)
    second = first
    call expect(second%system%particle_count() == 2, "copied as a whole")
  end subroutine
end program
