# The whole study as a graph of files. `snakemake -j2` makes everything; each of the target
# rules simulations, dataset, autoencoders, node, forecasts, errors and figures makes one stage and what
# it needs. Not part of everything: check_simulations runs every simulation a second time; scenes
# runs and draws the files in scenes/; effects measures what each effect costs and changes;
# third_dimension finds where planar motion ceases to be stable; states follows all steady states;
# hard_cases measures the program where such programs usually break; cost measures what accuracy costs in time.


configfile: "config.yaml"


report: "workflow/report/study.rst"


include: "workflow/rules/common.smk"
include: "workflow/rules/reporting.smk"
include: "workflow/rules/simulations.smk"
include: "workflow/rules/dataset.smk"
include: "workflow/rules/autoencoders.smk"
include: "workflow/rules/node.smk"
include: "workflow/rules/forecasts.smk"
include: "workflow/rules/errors.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/films.smk"
include: "workflow/rules/report.smk"
include: "workflow/rules/explorer.smk"
include: "workflow/rules/scenes.smk"
include: "workflow/rules/states.smk"
include: "workflow/rules/hard_cases.smk"
include: "workflow/rules/cost.smk"


# Snakemake starts at most 100 jobs a second unless told otherwise. To look again when the second is
# over, it sets a timer at each look while jobs wait, and each timer's end is another look: every
# finished job adds one look a second for the rest of the run, a third of a core in all. A longer
# timespan makes them fewer, but the end of the run waits for the last timer. So the limit goes; one
# that a user or a profile sets stays.
onstart:
    limiter = workflow.scheduler.job_rate_limiter
    if limiter is not None and (limiter.max_jobs, limiter.timespan) == (100, 1):
        workflow.scheduler.job_rate_limiter = None


STUDY_RESULTS = [
    rules.simulations.input,
    rules.dataset.input,
    rules.autoencoders.input,
    rules.node.input,
    rules.forecasts.input,
    rules.errors.input,
    rules.figures.input,
    rules.make_explorer.output,
    rules.tabulate_regimes.output,
    rules.tabulate_key_numbers.output,
]


include: "workflow/rules/provenance.smk"
include: "workflow/rules/published.smk"


rule all:
    default_target: True
    input:
        STUDY_RESULTS,
        rules.tabulate_timings.output,
        rules.write_manifest.output,
        rules.show_manifest.output,
        expand("results/report/{table}.html", table=TABLES),


# Every job has a log. Its time stands under the same name, and conda, where a user asks for it, makes
# one environment for all.
for job in workflow.rules:
    for log in job.log:
        job.benchmark_modifier = workflow.modifier.path_modifier  # as for a directive of the rule
        job.benchmark = log.replace("results/logs/", "results/benchmarks/").replace(".log", ".tsv")
        job.conda_env = str(BASE / "envs/environment.yaml")
