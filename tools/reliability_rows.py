"""The rows of docs/reliability.md: which tests inject a fault, what they look for, and what it means for a user."""

from __future__ import annotations

from dataclasses import dataclass

CHAIN, SOLVERS, INPUT, PROOFS = "The chain", "Solvers and numbers", "Paper folders", "Proofs and printed digits"
EQUAL = "recovered, bytes equal to a clean run"
PIPELINE, FAULTS, FUZZ = "tests/test_pipeline.py", "tests/test_faults.py", "tests/test_fuzz.py"
VERIFIER = "tests/lmi/test_verifier_fuzz.py"


@dataclass(frozen=True)
class Row:
    """One row; ``tests`` are "file::function" or the beginning of one parametrised name, "file::function[x".

    ``message`` is what the tests look for in the output. ``hypothesis``: each test stands for RECONTROL_FUZZ cases.
    """

    heading: str
    fault: str
    tests: tuple[str, ...]
    message: str
    means: str
    result: str = EQUAL
    hypothesis: bool = False


ROWS = (
    Row(
        CHAIN,
        "kill -9 at seeded moments",
        (f"{FAULTS}::test_killed_at_seeded_moments[toy",),
        "none needed",
        "Kill a run, or Snakemake alone so that its stages live on as orphans, five times in a row while a rebuild "
        "goes on. The plain command takes up what is whole and makes the rest; nothing has to be unlocked or "
        "deleted.",
    ),
    Row(
        CHAIN,
        "the same with all papers",
        (f"{FAULTS}::test_killed_at_seeded_moments[all papers",),
        "none needed",
        "As above, ten kills a rebuild of everything.",
    ),
    Row(
        CHAIN,
        "an orphan of a killed run finishes late",
        (f"{PIPELINE}::test_orphan_of_a_killed_run_writes_nothing",),
        "`this stage belongs to a run that has ended`",
        "What a stage of the old run still computes is thrown away; it cannot overwrite what the new run made.",
        "nothing written",
    ),
    Row(
        CHAIN,
        "full disk",
        (f"{FAULTS}::test_results_cannot_be_written[size",),
        "`cannot be written (No space left on device); free some space ...`",
        "No half-written file stays behind. Free some space and run the same command again.",
    ),
    Row(
        CHAIN,
        "read-only results",
        (f"{FAULTS}::test_results_cannot_be_written[ro",),
        "`cannot be written (Read-only file system); ... mend the permissions ...`",
        "As above, after mending the mount or the permissions.",
    ),
    Row(
        CHAIN,
        "artifact truncated, emptied, garbled or swapped",
        (f"{FAULTS}::test_damaged_artifact",),
        "`decay.npz differs from its record`",
        "An artifact is never read unless its bytes are those that a stage wrote. The damaged one is moved to "
        "`run/set-aside/` and made again.",
    ),
    Row(
        CHAIN,
        "artifact edited by hand",
        (f"{PIPELINE}::test_hand_edited_artifact_is_named_and_rebuilt",),
        "`gain.json differs from its record`",
        "A result cannot be improved by an editor; the edited file is kept aside, so no work is lost.",
    ),
    Row(
        CHAIN,
        "artifact edited while a run goes on",
        (f"{PIPELINE}::test_stage_refuses_an_artifact_edited_while_the_run_goes_on",),
        "`model.json: differs from its record`",
        "The stage that would read it stops instead.",
        "refused",
    ),
    Row(
        CHAIN,
        "intermediate file deleted",
        (f"{PIPELINE}::test_deleted_intermediate_is_rebuilt",),
        "none needed",
        "The plain command makes it again, although everything after it is still there.",
    ),
    Row(
        CHAIN,
        "records of provenance lost",
        (f"{FAULTS}::test_lost_records",),
        "`has no record of who made it`",
        "Without its record an artifact proves nothing, so everything is made again.",
    ),
    Row(
        CHAIN,
        "two runs at once",
        (f"{PIPELINE}::test_second_run_is_refused_in_words",),
        "`another run is going on in this directory (process ...)`",
        "The second one is refused and the first one is not disturbed. The lock goes with its process, so there is "
        "never a stale one to remove.",
    ),
    Row(
        CHAIN,
        "a stage that raises",
        (f"{PIPELINE}::test_failing_stage_fails_again_and_leaves_no_old_verdict",),
        "the error, and the path of the stage's log",
        "The claims that need it are `failed`, all others keep their verdicts, and the report shows both. The run "
        "fails until the cause is mended.",
    ),
    Row(
        CHAIN,
        "clock decades off",
        (f"{FAULTS}::test_clock_far_off", f"{FAULTS}::test_results_dated_in_the_future_do_not_hide_an_edit"),
        "`carries a time in the future`",
        "Files dated 1990 or 2090 hide no edit and cause no endless rebuilding.",
        "recovered; edits are seen",
    ),
    Row(
        CHAIN,
        "lock file that does not match or that pip refuses, unfinished environment",
        (
            f"{FAULTS}::test_half_made_environment_is_built_again",
            f"{FAULTS}::test_unreadable_lock_leaves_no_environment",
            "tests/test_environment.py::test_a_failing_step_says_what_to_do_and_leaves_no_stamp",
        ),
        "`unfinished or outdated`; the step that failed",
        "An environment that does not have the stamp of its lock file is cleared and made anew by `make reproduce`;"
        " one that cannot be made is never taken for complete.",
        "recovered after mending the lock",
    ),
    Row(
        SOLVERS,
        "a solver crashes, hangs, lies, loses its numbers, panics, or kills its stage",
        ("tests/test_solver_faults.py::test_faulty_solvers_fail_their_stages_in_words",),
        "`crashed: the solver's process ended with code 11`; `out of time: stopped after 1 s`; `violated`; `not "
        "finite`",
        "The message names the stage and its log. What a solver calls optimal is checked at the point that it "
        "returns; a wrong point makes the claim `failed`, never reproduced. A solver that takes the stage's process"
        " along leaves no words of its own, but Snakemake names the job and its log.",
    ),
    Row(
        SOLVERS,
        "the same, called from Python",
        (
            "tests/lmi/test_solving.py::test_a_lying_solver_is_not_believed",
            "tests/lmi/test_solving.py::test_crash_hang_and_exception_are_outcomes",
            "tests/lmi/test_solving.py::test_a_time_limit_binds_a_real_solver",
        ),
        "the solver's words, and why they are not believed",
        "The outcome is `failed` or `inaccurate` with the reason, and no exception.",
        "recorded as outcomes",
    ),
    Row(
        SOLVERS,
        "numbers that are not finite",
        (f"{PIPELINE}::test_non_finite_artifact_is_refused",),
        "`value.pole is inf`",
        "No artifact holds NaN or infinity; the stage that would write one names the entry.",
    ),
    Row(
        INPUT,
        "`paper.yaml` and `claims.yaml` with seeded edits",
        (f"{FUZZ}::test_mutated_files_are_refused_in_words_or_mean_what_they_say",),
        "file, line and key",
        "Lines lost, doubled, swapped or indented, words and characters put in. What is accepted holds the printed "
        "texts that stand in the file, and no tag, anchor or alias.",
        "no traceback; {accepted} were still valid, all others refused",
    ),
    Row(
        INPUT,
        "arbitrary trees as `paper.yaml`",
        (f"{FUZZ}::test_arbitrary_trees_are_refused",),
        "file and key",
        "Any nesting of lists, texts and numbers that is no paper.",
        "all refused",
        hypothesis=True,
    ),
    Row(
        INPUT,
        "arbitrary bytes",
        (f"{FUZZ}::test_arbitrary_bytes_are_refused_or_read_as_text",),
        "file and line",
        "What is accepted is text throughout: no number, date or object is made from it.",
        "refused or read as text",
        hypothesis=True,
    ),
    Row(
        INPUT,
        "hostile sizes",
        (f"{FUZZ}::test_hostile_sizes_are_refused",),
        "file",
        "Thousands of nested brackets, or megabytes of text.",
        "all refused",
    ),
    Row(
        PROOFS,
        "certificate damaged, digest as it was",
        (f"{VERIFIER}::test_damaged_certificates_with_the_old_digest_are_refused",),
        "`the digest does not fit the content`",
        "A certificate that was touched is refused.",
        "all refused",
    ),
    Row(
        PROOFS,
        "certificate damaged, digest computed again, standing alone",
        (f"{VERIFIER}::test_damaged_certificates_standing_alone_are_accepted_only_if_true",),
        "the condition, entry or unknown at fault",
        "Somebody who computes the digest again is believed only where the arithmetic is still true. A second "
        "opinion in plain fractions, with other algorithms and no code of the verifier, judges each one that is "
        "accepted; where entries are balls it may stay open (in at most one of fifty).",
        "{accepted} accepted, none found false; all others refused",
    ),
    Row(
        PROOFS,
        "the same, held against the paper",
        (f"{VERIFIER}::test_damaged_certificates_are_accepted_with_the_paper_only_if_true_of_it",),
        "the datum, box or matrix that differs",
        "With the paper's folder at hand the conditions, data and boxes must be the paper's; the second opinion "
        "writes the conditions of a small paper once more. What the paper does not give is named in the answer.",
        "{accepted} accepted, none found false; all others refused",
    ),
    Row(
        PROOFS,
        "certificates of a finished run of all papers, damaged",
        ("tests/test_built_certificates.py::test_damaged_certificates_are_accepted_only_if_true",),
        "as above",
        "The papers' own certificates (files below 150 kB), with the old digest and with a new one. Those accepted "
        "differ in nothing that the statement is about.",
        "{accepted} accepted, none found false; all others refused",
    ),
    Row(
        PROOFS,
        "one printed digit of an agreeing claim changed",
        ("tests/test_built.py::test_every_printed_digit_that_agrees_matters",),
        "another verdict",
        "Each digit of every claim that is compared as a number and agrees, changed to each other digit. Those that"
        " keep their verdict are listed below with the reason.",
        "{changed} change the verdict",
    ),
)
