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
        expand("results/report/{table}.html", table=STUDY_TABLES),
