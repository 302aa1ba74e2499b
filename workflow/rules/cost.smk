# What accuracy costs in time. Jobs that measure take all cores, so that nothing runs beside them;
# times differ from run to run, counts and errors do not.


rule measure_integrators:
    output:
        "results/costs/integrators/B{B}_k{k}.csv",
    log:
        "results/logs/measure_integrators/B{B}_k{k}.log",
    threads: EVERY_CORE
    params:
        code=code_of("measure_integrators"),
        settings=lambda wildcards: as_json(STUDY.integrator_settings(**wildcards)),
    shell:
        "sedfiber measure_integrators --settings {params.settings:q} -o {output} > {log} 2>&1"


rule tabulate_costs:
    input:
        lambda wildcards: COST_CASES[wildcards.table],
    output:
        "results/tables/cost_{table}.csv",
    log:
        "results/logs/tabulate_costs/{table}.log",
    wildcard_constraints:
        table="integrators|model_growth",
    params:
        code=code_of("tabulate_costs"),
    shell:
        "sedfiber tabulate_costs {input} -o {output} > {log} 2>&1"


rule measure_trajectories:
    output:
        "results/tables/cost_trajectories.csv",
    log:
        "results/logs/measure_trajectories.log",
    threads: EVERY_CORE
    params:
        code=code_of("measure_trajectories"),
        settings=as_json(STUDY.trajectories_settings),
    shell:
        "sedfiber measure_trajectories --settings {params.settings:q} -o {output} > {log} 2>&1"


rule measure_discretisation:
    output:
        table="results/tables/cost_discretisation.csv",
        growth="results/tables/cost_growth.csv",
    log:
        "results/logs/measure_discretisation.log",
    threads: EVERY_CORE
    resources:
        mem_mb=2000,
        runtime=15,
    params:
        code=code_of("measure_discretisation"),
        settings=as_json(config["cost"]["discretisation"]),
    shell:
        "sedfiber measure_discretisation --settings {params.settings:q}"
        " -o {output.table} --growth {output.growth} > {log} 2>&1"


# The study trains three neural ODEs for minutes each; here one for every variant, dimension and
# seed, in seconds, on the study's autoencoders.
use rule train_node as train_short_node with:
    input:
        training=split_files("train"),
        autoencoder=lambda wildcards: model_files(short_autoencoder(wildcards)),
    output:
        model_files("results/models/short/{variant}_d{dim}_s{seed}"),
    log:
        "results/logs/train_short_node/{variant}_d{dim}_s{seed}.log",
    params:
        code=code_of("train_node"),
        autoencoder=short_autoencoder,
        settings=lambda wildcards: as_json(STUDY.short_node_settings(wildcards.seed)),
        folder=lambda wildcards, output: Path(output[0]).parent,


rule measure_models:
    input:
        models=[model_files(model["folder"]) for model in COST_MODELS],
        tests=[split_files(split) for split in TEST_SETS],
        reconstruction="results/tables/reconstruction.csv",
        curve="results/terminal_shapes/terminal_curve.parquet",
    output:
        "results/tables/cost_models.csv",
    log:
        "results/logs/measure_models.log",
    threads: EVERY_CORE
    resources:
        mem_mb=2000,
    params:
        code=code_of("measure_models"),
        settings=as_json({"models": COST_MODELS}),
    shell:
        "sedfiber measure_models {input.tests} --reconstruction {input.reconstruction}"
        " --terminal-curve {input.curve} --settings {params.settings:q} -o {output} > {log} 2>&1"


rule measure_choices:
    input:
        models=[model_files(model["folder"]) for model in ASKED_MODELS],
        training=split_files("train"),
        tests=[split_files(split) for split in TEST_SETS],
        curve="results/terminal_shapes/terminal_curve.parquet",
    output:
        table="results/tables/cost_forecast.csv",
        at_each_B="results/tables/cost_choices.csv",
    log:
        "results/logs/measure_choices.log",
    threads: EVERY_CORE
    resources:
        mem_mb=3000,
        runtime=20,
    params:
        code=code_of("measure_choices"),
        settings=as_json(
            {
                "models": ASKED_MODELS,
                "judged_by_torch": FORECAST_MODEL,
                "data_benchmarks": benchmarks_of("simulate", trajectories("train")),
                "tried": config["cost"]["choices"],
            }
        ),
    shell:
        "sedfiber measure_choices {input.training} --tests {input.tests} --terminal-curve {input.curve}"
        " --settings {params.settings:q} -o {output.table} --at-each-B {output.at_each_B} > {log} 2>&1"


rule measure_model_growth:
    output:
        "results/costs/model_growth/N{n_beads}.csv",
    log:
        "results/logs/measure_model_growth/N{n_beads}.log",
    wildcard_constraints:
        n_beads=r"\d+",
    threads: EVERY_CORE
    resources:
        mem_mb=3000,
        runtime=15,
    params:
        code=code_of("measure_model_growth"),
        settings=lambda wildcards: as_json(STUDY.model_growth_settings(wildcards.n_beads)),
    shell:
        "sedfiber measure_model_growth --settings {params.settings:q} -o {output} > {log} 2>&1"


rule cost:
    input:
        rules.measure_trajectories.output,
        figures_of("cost"),
