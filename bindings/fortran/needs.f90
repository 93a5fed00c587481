! What a scene can do without for a wanted accuracy, and what resolution it asks for.
module hooke_needs_of_scenes
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_funloc, c_int32_t, c_int64_t, c_loc, &
    c_null_funptr, c_null_ptr, c_ptr
  use hooke_base, only: accept, hooke_bad_value, is_3_by, refuse, to_c, to_c_if, to_integer, to_text, zero_based
  use hooke_c_io, only: c_needs_write_report
  use hooke_c_needs
  use hooke_handles, only: hooke_handle
  use hooke_observers, only: call_progress, hooke_progress, progress_holder
  use hooke_option_tables, only: hooke_options, options_or_null
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_needs

  integer, parameter :: of_progress = 1

  type, extends(hooke_handle) :: hooke_needs
    ! Found by find(): the lean system, and the run to make of it.
    type(hooke_system) :: lean
    type(hooke_options) :: lean_run
    integer(c_int64_t), private :: particles = 0
  contains
    procedure :: create
    procedure :: on_progress
    procedure :: find
    procedure :: refine
    procedure :: figure
    procedure :: word
    procedure :: row_count
    procedure :: text
    procedure :: number
    procedure :: lean_particle
    procedure :: lean_position
    procedure :: part_count
    procedure :: part_text
    procedure :: part_number
    procedure :: write_report
    procedure :: destroy
    procedure, private :: assign
    generic :: assignment(=) => assign
  end type

contains

  ! `run` is of a run, `options` are `want` [m] and `watch`, whose particles count from 0 as in a scene.
  subroutine create(self, system, run, options, status)
    class(hooke_needs), intent(inout) :: self
    class(hooke_system), intent(in) :: system
    type(hooke_options), intent(in), optional :: run, options
    integer, intent(out), optional :: status
    type(c_ptr) :: needs
    integer(c_int32_t) :: code
    if (system%is_missing(status)) return
    code = c_needs_create(system%address(), options_or_null(run), options_or_null(options), needs)
    if (code == 0) then
      call self%take(needs, c_needs_destroy, system)
      self%particles = system%particle_count()
    end if
    call accept(code, status)
  end subroutine

  ! Told of progress; has to stay where it is as long as it is. Without one it is taken back.
  subroutine on_progress(self, progress)
    class(hooke_needs), intent(inout) :: self
    class(hooke_progress), target, intent(inout), optional :: progress
    type(progress_holder), pointer :: holder
    if (.not. present(progress)) then
      call c_needs_on_progress(self%address(), c_null_funptr, c_null_ptr)
      return
    end if
    allocate (holder)
    holder%progress => progress
    call c_needs_on_progress(self%address(), c_funloc(call_progress), c_loc(holder))
    call self%keep(holder, of_progress)
  end subroutine

  ! Fills the table, then finds the lean system; once.
  subroutine find(self, status)
    class(hooke_needs), intent(inout) :: self
    integer, intent(out), optional :: status
    integer(c_int32_t) :: code
    type(c_ptr) :: lean, run
    if (self%is_missing(status)) return
    code = c_needs_find(self%address())
    lean = c_needs_lean(self%address())
    run = c_needs_lean_run(self%address())
    if (c_associated(lean)) call self%lean%take(lean, owner=self)
    if (c_associated(lean) .and. c_associated(run)) call self%lean_run%take(run, owner=self)
    call accept(code, status)
  end subroutine

  ! Each part at once, twice and four times its resolution; once.
  subroutine refine(self, status)
    class(hooke_needs), intent(inout) :: self
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_needs_refine(self%address()), status)
  end subroutine

  real(c_double) function figure(self, what)
    class(hooke_needs), intent(in) :: self
    character(*), intent(in) :: what
    figure = c_needs_figure(self%address(), to_c(what))
  end function

  function word(self, what) result(text)
    class(hooke_needs), intent(in) :: self
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_needs_word(self%address(), to_c(what)))
  end function

  ! ---- rows: what was left out ----

  integer function row_count(self)
    class(hooke_needs), intent(in) :: self
    row_count = to_integer(c_needs_row_count(self%address()))
  end function

  function text(self, row, what)
    class(hooke_needs), intent(in) :: self
    integer, intent(in) :: row
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_needs_text(self%address(), zero_based(row), to_c(what)))
  end function

  real(c_double) function number(self, row, what)
    class(hooke_needs), intent(in) :: self
    integer, intent(in) :: row
    character(*), intent(in) :: what
    number = c_needs_number(self%address(), zero_based(row), to_c(what))
  end function

  ! Where the lean system has a particle of the full one; 0 if it was left out.
  integer function lean_particle(self, particle)
    class(hooke_needs), intent(in) :: self
    integer, intent(in) :: particle
    lean_particle = int(c_needs_lean_particle(self%address(), zero_based(particle))) + 1
  end function

  ! Positions of all particles of the full system at positions q of the lean one, NaN where they were left out.
  subroutine lean_position(self, q, position, status)
    class(hooke_needs), intent(in) :: self
    real(c_double), intent(in), contiguous :: q(:, :)
    real(c_double), intent(inout), contiguous :: position(:, :)
    integer, intent(out), optional :: status
    logical :: fits
    if (self%is_missing(status)) return
    if (self%lean%is_missing(status)) return
    fits = is_3_by(q, int(self%lean%particle_count(), c_int64_t)) .and. is_3_by(position, self%particles)
    if (.not. fits) then
      call refuse(hooke_bad_value, "an array has not the shape (3, particle_count()) of its system", status)
      return
    end if
    call accept(c_needs_lean_position(self%address(), q, position), status)
  end subroutine

  ! ---- resolution, one row a part ----

  integer function part_count(self)
    class(hooke_needs), intent(in) :: self
    part_count = to_integer(c_needs_part_count(self%address()))
  end function

  function part_text(self, part, what) result(text)
    class(hooke_needs), intent(in) :: self
    integer, intent(in) :: part
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_needs_part_text(self%address(), zero_based(part), to_c(what)))
  end function

  real(c_double) function part_number(self, part, what)
    class(hooke_needs), intent(in) :: self
    integer, intent(in) :: part
    character(*), intent(in) :: what
    part_number = c_needs_part_number(self%address(), zero_based(part), to_c(what))
  end function

  ! One HTML page; `scene` is the name over it, `command` the line to type for the lean scene.
  subroutine write_report(self, path, scene, command, status)
    class(hooke_needs), intent(in) :: self
    character(*), intent(in) :: path, scene
    character(*), intent(in), optional :: command
    integer, intent(out), optional :: status
    character(:), allocatable :: c_command
    if (self%is_missing(status)) return
    call to_c_if(command, c_command)
    call accept(c_needs_write_report(self%address(), to_c(path), to_c(scene), c_command), status)
  end subroutine

  impure elemental subroutine assign(self, other)
    class(hooke_needs), intent(inout) :: self
    type(hooke_needs), intent(in) :: other
    if (self%has_that_of(other)) return
    call self%share(other)
    self%particles = other%particles
    self%lean = other%lean
    self%lean_run = other%lean_run
  end subroutine

  subroutine destroy(self)
    class(hooke_needs), intent(inout) :: self
    call self%lean%destroy()
    call self%lean_run%destroy()
    call self%hooke_handle%destroy()
  end subroutine
end module
