! Whether a trajectory is what its scene gives.
module hooke_verifications
  use, intrinsic :: iso_c_binding, only: c_double, c_funloc, c_int32_t, c_loc, c_null_funptr, c_null_ptr, c_ptr
  use hooke_base, only: accept, to_c, to_text
  use hooke_c_verify
  use hooke_handles, only: hooke_handle
  use hooke_observers, only: call_progress, hooke_progress, progress_holder
  use hooke_option_tables, only: hooke_options, options_or_null
  implicit none
  private
  public :: hooke_verify

  integer, parameter :: of_progress = 1

  type, extends(hooke_handle) :: hooke_verify
  contains
    procedure :: create
    procedure :: on_progress
    procedure :: run
    procedure :: text
    procedure :: number
    procedure, private :: assign
    generic :: assignment(=) => assign
  end type

contains

  ! Opens a trajectory; `options` are of create_verify(), `limits` of create_scene("limits").
  subroutine create(self, path, options, limits, status)
    class(hooke_verify), intent(inout) :: self
    character(*), intent(in) :: path
    type(hooke_options), intent(in), optional :: options, limits
    integer, intent(out), optional :: status
    type(c_ptr) :: verify
    integer(c_int32_t) :: code
    code = c_verify_create(to_c(path), options_or_null(options), options_or_null(limits), verify)
    if (code == 0) call self%take(verify, c_verify_destroy)
    call accept(code, status)
  end subroutine

  ! Told of progress; has to stay where it is as long as it is. Without one it is taken back.
  subroutine on_progress(self, progress)
    class(hooke_verify), intent(inout) :: self
    class(hooke_progress), target, intent(inout), optional :: progress
    type(progress_holder), pointer :: holder
    if (.not. present(progress)) then
      call c_verify_on_progress(self%address(), c_null_funptr, c_null_ptr)
      return
    end if
    allocate (holder)
    holder%progress => progress
    call c_verify_on_progress(self%address(), c_funloc(call_progress), c_loc(holder))
    call self%keep(holder, of_progress)
  end subroutine

  ! Does all of it; hooke_bad_value if the file is not what its scene gives.
  subroutine run(self, status)
    class(hooke_verify), intent(inout) :: self
    integer, intent(out), optional :: status
    if (self%is_missing(status)) return
    call accept(c_verify_run(self%address()), status)
  end subroutine

  ! "verdict", "difference" and the others of hooke/verify.h.
  function text(self, what)
    class(hooke_verify), intent(in) :: self
    character(*), intent(in) :: what
    character(:), allocatable :: text
    text = to_text(c_verify_text(self%address(), to_c(what)))
  end function

  real(c_double) function number(self, what)
    class(hooke_verify), intent(in) :: self
    character(*), intent(in) :: what
    number = c_verify_number(self%address(), to_c(what))
  end function

  impure elemental subroutine assign(self, other)
    class(hooke_verify), intent(inout) :: self
    type(hooke_verify), intent(in) :: other
    call self%share(other)
  end subroutine
end module
