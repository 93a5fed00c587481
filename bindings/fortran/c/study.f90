! Made from include/hooke/study.h by make_interfaces.py.
module hooke_c_study
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
  implicit none

  interface
    integer(c_int32_t) function c_study_options_create(options) bind(c, name="hooke_study_options_create")
      import
      type(c_ptr), intent(out) :: options
    end function
    integer(c_int32_t) function c_study_create(system, run, options, study) bind(c, name="hooke_study_create")
      import
      type(c_ptr), value :: system, run, options
      type(c_ptr), intent(out) :: study
    end function
    subroutine c_study_destroy(study) bind(c, name="hooke_study_destroy")
      import
      type(c_ptr), value :: study
    end subroutine
    subroutine c_study_on_progress(study, progress, ctx) bind(c, name="hooke_study_on_progress")
      import
      type(c_ptr), value :: study, ctx
      type(c_funptr), value :: progress
    end subroutine
    integer(c_int32_t) function c_study_run(study) bind(c, name="hooke_study_run")
      import
      type(c_ptr), value :: study
    end function
    type(c_ptr) function c_study_reference(study, what) bind(c, name="hooke_study_reference")
      import
      type(c_ptr), value :: study
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    real(c_double) function c_study_figure(study, what) bind(c, name="hooke_study_figure")
      import
      type(c_ptr), value :: study
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    integer(c_int64_t) function c_study_row_count(study) bind(c, name="hooke_study_row_count")
      import
      type(c_ptr), value :: study
    end function
    type(c_ptr) function c_study_text(study, row, what) bind(c, name="hooke_study_text")
      import
      type(c_ptr), value :: study
      integer(c_int64_t), value :: row
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    real(c_double) function c_study_number(study, row, what) bind(c, name="hooke_study_number")
      import
      type(c_ptr), value :: study
      integer(c_int64_t), value :: row
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    integer(c_int64_t) function c_study_frame_count(study) bind(c, name="hooke_study_frame_count")
      import
      type(c_ptr), value :: study
    end function
    type(c_ptr) function c_study_series(study, row, what) bind(c, name="hooke_study_series")
      import
      type(c_ptr), value :: study
      integer(c_int64_t), value :: row
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    real(c_double) function c_study_order(study, method, what) bind(c, name="hooke_study_order")
      import
      type(c_ptr), value :: study
      character(kind=c_char), intent(in), optional :: method(*), what(*)
    end function
    type(c_ptr) function c_study_order_note(study, method) bind(c, name="hooke_study_order_note")
      import
      type(c_ptr), value :: study
      character(kind=c_char), intent(in), optional :: method(*)
    end function
    integer(c_int32_t) function c_study_recommend(study, want) bind(c, name="hooke_study_recommend")
      import
      type(c_ptr), value :: study
      real(c_double), value :: want
    end function
    type(c_ptr) function c_study_recommendation_text(study, what) bind(c, name="hooke_study_recommendation_text")
      import
      type(c_ptr), value :: study
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    real(c_double) function c_study_recommendation_number(study, what) bind(c, name="hooke_study_recommendation_number")
      import
      type(c_ptr), value :: study
      character(kind=c_char), intent(in), optional :: what(*)
    end function
    real(c_double) function c_study_statistic(study, method, quantity, what) bind(c, name="hooke_study_statistic")
      import
      type(c_ptr), value :: study
      character(kind=c_char), intent(in), optional :: method(*), quantity(*), what(*)
    end function
    integer(c_int32_t) function c_study_pick(system, run, want, progress, ctx) bind(c, name="hooke_study_pick")
      import
      type(c_ptr), value :: system, run, ctx
      real(c_double), value :: want
      type(c_funptr), value :: progress
    end function
  end interface
end module
