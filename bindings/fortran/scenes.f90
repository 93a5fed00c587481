! Scene files (JSON): a system and the options of a run.
module hooke_scenes
  use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_int64_t, c_ptr
  use hooke_base, only: accept, to_c, to_c_if
  use hooke_c_scene
  use hooke_handles, only: address_or_null
  use hooke_option_tables, only: hooke_options
  use hooke_queries_of_scene
  use hooke_systems, only: hooke_system
  implicit none
  private
  public :: hooke_scene

  type, extends(hooke_scene_queries) :: hooke_scene
    type(hooke_system) :: system ! built, not yet committed
    type(hooke_options) :: run   ! those of `run`, which may be changed
  contains
    procedure :: load
    procedure :: parse
    procedure :: of_system
    procedure :: refresh
  end type

contains

  ! Reads a scene file, or the scene that a trajectory file was made from. `limits` are options of
  ! create("limits"): the maximum memory of the scene, and whether its files may be anywhere.
  subroutine load(self, path, status, limits)
    class(hooke_scene), intent(inout) :: self
    character(*), intent(in) :: path
    type(hooke_options), intent(in), optional :: limits
    integer, intent(out), optional :: status
    type(c_ptr) :: scene
    integer(c_int32_t) :: code
    code = c_scene_load(to_c(path), address_or_null(limits), scene)
    if (code == 0) call self%take(scene, c_scene_destroy)
    call accept(code, status)
  end subroutine

  ! The same from text; `name` replaces the file name in messages, `folder` is where files named in it are
  ! looked up (without it none are allowed).
  subroutine parse(self, text, name, folder, status, limits)
    class(hooke_scene), intent(inout) :: self
    character(*, kind=c_char), intent(in) :: text
    character(*), intent(in), optional :: name, folder
    type(hooke_options), intent(in), optional :: limits
    integer, intent(out), optional :: status
    character(:), allocatable :: c_name, c_folder
    type(c_ptr) :: scene
    integer(c_int32_t) :: code
    c_name = to_c("scene")
    if (present(name)) c_name = to_c(name)
    call to_c_if(folder, c_folder)
    code = c_scene_parse(text, len(text, c_int64_t), c_name, c_folder, address_or_null(limits), scene)
    if (code == 0) call self%take(scene, c_scene_destroy)
    call accept(code, status)
  end subroutine

  ! The scene that write_scene() of a committed system would write.
  subroutine of_system(self, system, title, run, name, folder, status)
    class(hooke_scene), intent(inout) :: self
    class(hooke_system), intent(in) :: system
    character(*), intent(in), optional :: title, name, folder
    type(hooke_options), intent(in), optional :: run
    integer, intent(out), optional :: status
    character(:), allocatable :: c_title, c_name, c_folder
    type(c_ptr) :: scene
    integer(c_int32_t) :: code
    if (system%is_missing(status)) return
    c_name = to_c("scene")
    if (present(name)) c_name = to_c(name)
    call to_c_if(title, c_title)
    call to_c_if(folder, c_folder)
    code = c_scene_of_system(system%address(), c_title, address_or_null(run), c_name, c_folder, scene)
    if (code == 0) call self%take(scene, c_scene_destroy)
    call accept(code, status)
  end subroutine

  subroutine refresh(self)
    class(hooke_scene), intent(inout) :: self
    call self%system%destroy()
    call self%run%destroy()
    if (.not. self%exists()) return
    call self%system%take(c_scene_system(self%address()), owner=self)
    call self%run%take(c_scene_run_options(self%address()), owner=self)
  end subroutine
end module
